#include "cavea/mesh/check.h"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "cavea/mesh/build.h"
#include "cavea/mesh/surface_edges.h"
#include "support/meshes.h"

namespace cavea {
namespace {

/// A cube of two references, with ridges and a required edge on its first axis.
TetMesh good_mesh() {
  MeshData data = test::kuhn_cube(3);
  test::set_refs(data, [](const Vec3& p) { return p.z > 0.34 ? 1 : 2; });
  data.edges = {{0, 1}, {0, 2}};
  data.edge_refs = {5, 6};
  data.ridges = {0, 1};
  return build(data).mesh;
}

TriangleId find_triangle(const TetMesh& mesh, const std::function<bool(const Triangle&)>& wanted) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    if (wanted(mesh.triangles[i])) return TriangleId(i);
  ADD_FAILURE() << "no such triangle";
  return kNone;
}

bool is_interface(const Triangle& s) { return s.sides[1].is_tet(); }
bool is_exterior(const Triangle& s) { return !is_interface(s); }

VertexId inner_vertex(const TetMesh& mesh) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (mesh.vertex_tags[v] == 0) return VertexId(v);
  ADD_FAILURE() << "no inner vertex";
  return kNone;
}

struct InnerFace {
  TetId t;
  int f;
};

InnerFace inner_face(const TetMesh& mesh) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (int f = 0; f < 4; ++f)
      if (mesh.links[t][f].is_tet()) return {TetId(t), f};
  ADD_FAILURE() << "no inner face";
  return {0, 0};
}

/// Breaks one thing; check() must say so, in these words.
struct Break {
  const char* name;
  const char* words;
  std::function<void(TetMesh&)> apply;
};

void PrintTo(const Break& b, std::ostream* out) { *out << b.name; }

class CheckFinds : public testing::TestWithParam<Break> {};

TEST_P(CheckFinds, TheBreak) {
  TetMesh mesh = good_mesh();
  ASSERT_EQ(check(mesh).message(), "sound");
  GetParam().apply(mesh);
  const CheckResult result = check(mesh);
  EXPECT_FALSE(result.sound());
  EXPECT_NE(result.message().find(GetParam().words), std::string::npos) << result.message();
}

const Break kArrayBreaks[] = {
    {"MissingSize", "sizes of vertices", [](TetMesh& m) { m.sizes.pop_back(); }},
    {"MissingTag", "tags of vertices", [](TetMesh& m) { m.vertex_tags.pop_back(); }},
    {"MissingVertexRef", "references of vertices", [](TetMesh& m) { m.vertex_refs.pop_back(); }},
    {"MissingVertexTet", "tets of vertices", [](TetMesh& m) { m.vertex_tets.pop_back(); }},
    {"MissingAnchor", "anchors of vertices", [](TetMesh& m) { m.anchors.pop_back(); }},
    {"MissingLinks", "links of tets", [](TetMesh& m) { m.links.pop_back(); }},
    {"MissingQuality", "qualities of tets", [](TetMesh& m) { m.qualities.pop_back(); }},
    {"MissingTetRef", "references of tets", [](TetMesh& m) { m.tet_refs.pop_back(); }},
    {"MissingFlags", "flags of tets", [](TetMesh& m) { m.tet_flags.pop_back(); }},
};
INSTANTIATE_TEST_SUITE_P(Arrays, CheckFinds, testing::ValuesIn(kArrayBreaks),
                         [](const auto& i) { return i.param.name; });

const Break kIndexBreaks[] = {
    {"VertexTetWithoutIt", "does not have it",
     [](TetMesh& m) {
       const VertexId v = inner_vertex(m);
       TetId t = 0;
       while (m.local_index(t, v) != 4) ++t;
       m.vertex_tets[v] = t;
     }},
    {"VertexTetOutOfRange", "does not have it",
     [](TetMesh& m) { m.vertex_tets[0] = TetId(m.tets.size()); }},
    {"Coordinate", "not finite",
     [](TetMesh& m) { m.points[0].y = std::numeric_limits<double>::quiet_NaN(); }},
    {"Size", "its size is", [](TetMesh& m) { m.sizes[2] = -1; }},
    {"DeadVertex", "vertex 0 does not exist", [](TetMesh& m) { m.vertex_tets[0] = kNone; }},
    {"VertexOutOfRange", "does not exist",
     [](TetMesh& m) { m.tets[0][1] = VertexId(m.points.size()); }},
    {"VertexTwice", "tet 0: has vertex", [](TetMesh& m) { m.tets[0][1] = m.tets[0][0]; }},
    {"LinkToDeadTet", "links to does not exist",
     [](TetMesh& m) { m.tets[m.tets.size() / 2][0] = kNone; }},
    {"LinkOutOfRange", "links to does not exist",
     [](TetMesh& m) { m.links[0][0] = FaceLink::to_tet(TetId(m.tets.size()), 0); }},
    {"LinkToDeadTriangle", "links to does not exist",
     [](TetMesh& m) { m.triangles[3].v[0] = kNone; }},
    {"TriangleVertexOutOfRange", "triangle 0: vertex",
     [](TetMesh& m) { m.triangles[0].v[1] = VertexId(m.points.size()); }},
    {"TriangleVertexTwice", "triangle 0: has vertex",
     [](TetMesh& m) { m.triangles[0].v[1] = m.triangles[0].v[0]; }},
    {"TriangleSideOutOfRange", "of side 0 does not exist",
     [](TetMesh& m) { m.triangles[0].sides[0] = FaceLink::to_tet(TetId(m.tets.size()), 0); }},
    {"TriangleOnTriangle", "of side 1 does not exist",
     [](TetMesh& m) { m.triangles[0].sides[1] = FaceLink::to_triangle(1); }},
};
INSTANTIATE_TEST_SUITE_P(Indices, CheckFinds, testing::ValuesIn(kIndexBreaks),
                         [](const auto& i) { return i.param.name; });

const Break kTetBreaks[] = {
    {"LinkNotMutual", "does not link back",
     [](TetMesh& m) {
       const auto [t, f] = inner_face(m);
       const FaceLink behind = m.links[t][f];
       m.links[behind.tet()][behind.face()] = FaceLink::to_tet(t, (f + 1) % 4);
     }},
    {"LinksExchanged", "with other vertices",
     [](TetMesh& m) {
       for (auto& links : m.links)
         if (links[0].is_tet() && links[1].is_tet()) {
           const auto exchange = [&](FaceLink behind, FaceLink there) {
             m.links[behind.tet()][behind.face()] = there;
           };
           const TetId t = TetId(&links - m.links.data());
           exchange(links[0], FaceLink::to_tet(t, 1));
           exchange(links[1], FaceLink::to_tet(t, 0));
           std::swap(links[0], links[1]);
           return;
         }
     }},
    {"TetTurned", "lies on the same side",
     [](TetMesh& m) {
       const auto [t, f] = inner_face(m);
       std::swap(m.tets[t][(f + 1) % 4], m.tets[t][(f + 2) % 4]);
     }},
    {"TetReference", "of another reference", [](TetMesh& m) { m.tet_refs[inner_face(m).t] = 77; }},
    {"LinkUnset", "nothing behind face",
     [](TetMesh& m) {
       const auto [t, f] = inner_face(m);
       m.links[t][f] = FaceLink{};
     }},
    {"LinkToOtherTriangle", "which is not on it",
     [](TetMesh& m) {
       const FaceLink side = m.triangles[0].sides[0];
       m.links[side.tet()][side.face()] = FaceLink::to_triangle(1);
     }},
    {"CutTwice", "cut 3 is used twice",
     [](TetMesh& m) {
       const auto [t, f] = inner_face(m);
       const FaceLink behind = m.links[t][f];
       m.links[t][f] = m.links[behind.tet()][behind.face()] = FaceLink::to_cut(3);
     }},
    {"Inverted", "its volume is negative",
     [](TetMesh& m) {
       m.points[inner_vertex(m)] = {3, 3, 3};
       for (TetId t = 0; t < TetId(m.tets.size()); ++t)
         m.qualities[t] = float(m.compute_quality(t));
     }},
    {"Flat", "its volume is zero",
     [](TetMesh& m) {
       const VertexId v = inner_vertex(m);
       const auto& tet = m.tets[m.vertex_tets[v]];
       m.points[v] = m.points[tet[0] == v ? tet[1] : tet[0]];
     }},
    {"Quality", "stored quality", [](TetMesh& m) { m.qualities[4] += 1e-5f; }},
    {"QualityIsNan", "stored quality",
     [](TetMesh& m) { m.qualities[4] = std::numeric_limits<float>::quiet_NaN(); }},
};
INSTANTIATE_TEST_SUITE_P(Tets, CheckFinds, testing::ValuesIn(kTetBreaks),
                         [](const auto& i) { return i.param.name; });

const Break kTriangleBreaks[] = {
    {"SideNotMutual", "of side 1 does not link back",
     [](TetMesh& m) {
       Triangle& s = m.triangles[find_triangle(m, is_interface)];
       s.sides[1] = FaceLink::to_tet(s.sides[1].tet(), (s.sides[1].face() + 1) % 4);
     }},
    {"OtherVertices", "has other vertices",
     [](TetMesh& m) { std::swap(m.triangles[0].v, m.triangles[5].v); }},
    {"Turned", "wrong way round",
     [](TetMesh& m) { std::swap(m.triangles[0].v[1], m.triangles[0].v[2]); }},
    {"SidesExchanged", "wrong way round",
     [](TetMesh& m) {
       Triangle& s = m.triangles[find_triangle(m, is_interface)];
       std::swap(s.sides[0], s.sides[1]);
     }},
    {"ExteriorOnWrongSide", "is on no tet",
     [](TetMesh& m) {
       Triangle& s = m.triangles[find_triangle(m, is_exterior)];
       std::swap(s.sides[0], s.sides[1]);
     }},
    {"InsideOneReference", "of one reference",
     [](TetMesh& m) {
       const auto& sides = m.triangles[find_triangle(m, is_interface)].sides;
       m.tet_refs[sides[0].tet()] = m.tet_refs[sides[1].tet()];
     }},
    {"Twins", "lie on the same three vertices",
     [](TetMesh& m) {
       const Triangle twin = m.triangles[0];
       m.triangles.push_back(twin);
     }},
};
INSTANTIATE_TEST_SUITE_P(Triangles, CheckFinds, testing::ValuesIn(kTriangleBreaks),
                         [](const auto& i) { return i.param.name; });

/// Changes the tags of all uses of the last edge that has all the bits of `has`, or of the last one
/// without tags. (The last ones are far from the listed edges.)
void retag(TetMesh& m, Tag has, Tag flip) {
  const SurfaceEdges edges(m);
  for (std::size_t i = m.triangles.size(); i-- > 0;) {
    const Triangle& s = m.triangles[i];
    for (int k = 0; k < 3; ++k)
      if ((s.edge_tag[k] & has) == has && (has != 0 || s.edge_tag[k] == 0)) {
        for (const std::uint32_t use : edges.find(m, s.v[(k + 1) % 3], s.v[(k + 2) % 3])) {
          const auto [triangle, local] = SurfaceEdges::decode(use);
          m.triangles[triangle].edge_tag[local] ^= flip;
        }
        return;
      }
  }
  ADD_FAILURE() << "no edge of tags " << has;
}

void clear_bit(TetMesh& m, Tag bit) {
  for (Tag& tags : m.vertex_tags)
    if (tags & bit) {
      tags = Tag(tags & ~bit);
      return;
    }
  ADD_FAILURE() << "no vertex of tag " << bit;
}

const Break kTagBreaks[] = {
    {"EdgeTag", "tag it differently",
     [](TetMesh& m) { m.triangles[0].edge_tag[1] ^= tag::kRidge; }},
    {"EdgeRef", "give it different references", [](TetMesh& m) { ++m.triangles[0].edge_ref[1]; }},
    {"ReferenceEdgeUntagged", "lies between references and is not tagged so",
     [](TetMesh& m) { retag(m, tag::kReferenceEdge, tag::kReferenceEdge); }},
    {"NonManifoldUntagged", "3 triangles and is not tagged as non-manifold",
     [](TetMesh& m) { retag(m, tag::kNonManifold, tag::kNonManifold); }},
    {"ManifoldTagged", "2 triangles and is tagged as non-manifold",
     [](TetMesh& m) { retag(m, 0, tag::kNonManifold); }},
    {"RidgeWithoutVertices", "is on a ridge and is not tagged so",
     [](TetMesh& m) { retag(m, 0, tag::kRidge); }},
    {"RequiredWithoutVertices", "is required and is not tagged so",
     [](TetMesh& m) { retag(m, 0, tag::kRequired); }},
    {"RequiredTriangleWithoutVertices", "is required and is not tagged so",
     [](TetMesh& m) { m.triangles[0].tags |= tag::kRequired; }},
    {"NotOnSurface", "is on the surface and is not tagged so",
     [](TetMesh& m) { clear_bit(m, tag::kSurface); }},
    {"NotOnRidge", "is on a ridge and is not tagged so",
     [](TetMesh& m) { clear_bit(m, tag::kRidge); }},
    {"NotOnReferenceEdge", "is on a reference edge and is not tagged so",
     [](TetMesh& m) { clear_bit(m, tag::kReferenceEdge); }},
    {"NotOnNonManifold", "is on a non-manifold edge and is not tagged so",
     [](TetMesh& m) { clear_bit(m, tag::kNonManifold); }},
    {"InsideOnSurface", "is tagged as on the surface and is not",
     [](TetMesh& m) { m.vertex_tags[inner_vertex(m)] = tag::kSurface; }},
    {"InsideOnRidge", "is tagged as on a ridge and is not",
     [](TetMesh& m) { m.vertex_tags[inner_vertex(m)] = tag::kRidge; }},
};
INSTANTIATE_TEST_SUITE_P(Tags, CheckFinds, testing::ValuesIn(kTagBreaks),
                         [](const auto& i) { return i.param.name; });

TEST(Check, AcceptsCutsUsedOnceAndFrozenVertices) {
  TetMesh mesh = good_mesh();
  const auto [t, f] = inner_face(mesh);
  const FaceLink behind = mesh.links[t][f];
  mesh.links[t][f] = FaceLink::to_cut(0);
  mesh.links[behind.tet()][behind.face()] = FaceLink::to_cut(1);
  mesh.vertex_tags[inner_vertex(mesh)] = tag::kSurface | tag::kRidge | tag::kFrozen;
  EXPECT_EQ(check(mesh).message(), "sound");
}

TEST(Check, AcceptsOneSideOfAnInterfaceInAnotherPart) {
  for (int missing = 0; missing < 2; ++missing) {
    MeshData data = test::two_tets();
    data.tet_refs = {1, 2};
    TetMesh mesh = build(data).mesh;
    Triangle& s = mesh.triangles[find_triangle(mesh, is_interface)];
    const TetId gone = s.sides[missing].tet();
    s.sides[missing] = FaceLink::to_cut(0);
    for (Triangle& other : mesh.triangles)
      if (other.sides[0].is_tet() && other.sides[0].tet() == gone) other.v[0] = kNone;
    const VertexId apex = gone == 0 ? 0 : 4;
    mesh.tets[gone][0] = kNone;
    mesh.vertex_tets[apex] = kNone;
    for (VertexId v = 1; v < 4; ++v) {
      mesh.vertex_tets[v] = 1 - gone;
      mesh.vertex_tags[v] |= tag::kFrozen;
    }
    EXPECT_EQ(check(mesh).message(), "sound") << missing;
  }
}

TEST(Check, NamesOnlyTheFirstFew) {
  TetMesh mesh = good_mesh();
  for (float& q : mesh.qualities) q = 2;
  const CheckResult result = check(mesh);
  EXPECT_EQ(result.count, std::int64_t(mesh.tets.size()));
  EXPECT_LT(result.examples.size(), 20u);
  EXPECT_EQ(result.examples[0].find("tet 0: "), 0u);
}

}  // namespace
}  // namespace cavea
