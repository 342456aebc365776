#include "cavea/mesh/build.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/check.h"
#include "support/meshes.h"

namespace cavea {
namespace {

using test::Random;

template <class E, class F>
std::string message_of(F&& f) {
  try {
    f();
  } catch (const E& e) {
    return e.what();
  }
  return "nothing was thrown";
}

std::string build_error(const MeshData& data) {
  return message_of<InputError>([&] { build(data); });
}

TEST(Build, SingleTet) {
  const BuildResult r = build(test::single_tet());
  const TetMesh& mesh = r.mesh;
  EXPECT_EQ(check(mesh).message(), "sound");
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(r.summary.made_triangles, 4);
  EXPECT_NEAR(mesh.qualities[0], 1, 1e-6);
  EXPECT_EQ(mesh.tet_flags[0], tet_flag::kAskAll);
  for (const Triangle& s : mesh.triangles) {
    EXPECT_EQ(s.ref, 1);
    const Vec3 &a = mesh.points[s.v[0]], &b = mesh.points[s.v[1]], &c = mesh.points[s.v[2]];
    const Vec3 centre = 0.25 * (mesh.points[0] + mesh.points[1] + mesh.points[2] + mesh.points[3]);
    EXPECT_GT(dot(cross(b - a, c - a), a - centre), 0) << "the normal points inwards";
  }
}

TEST(Build, LinksTwoTets) {
  const TetMesh mesh = build(test::two_tets()).mesh;
  EXPECT_EQ(check(mesh).message(), "sound");
  EXPECT_EQ(mesh.triangles.size(), 6u);
  EXPECT_EQ(mesh.links[0][0], FaceLink::to_tet(1, 3));
  EXPECT_EQ(mesh.links[1][3], FaceLink::to_tet(0, 0));
  EXPECT_EQ(mesh.across(0, 0).tet(), 1);
  EXPECT_TRUE(mesh.across(0, 1).is_unset());
  EXPECT_EQ(mesh.vertex_tets, (std::vector<TetId>{0, 0, 0, 0, 1}));
}

TEST(Build, SoundOnManyMeshes) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    MeshData cube = test::kuhn_cube(6);
    test::perturb_inside(cube, 0.1 / 6, seed);
    test::set_refs(cube, [&](const Vec3& p) {
      return p.x + 0.3 * p.y > 0.6 ? 5 : p.z > 0.5 ? 2 : 9;
    });
    for (const MeshData& data : {test::shuffled(cube, seed), test::shuffled(test::ball(5), seed),
                                 test::shuffled(test::polycube(5, 0.6, seed), seed)}) {
      const BuildResult r = build(data);
      EXPECT_EQ(check(r.mesh).message(), "sound");
      EXPECT_EQ(r.summary.turned_tets + r.summary.flat_tets + r.summary.dropped_triangles, 0);
      EXPECT_EQ(std::size_t(r.summary.made_triangles), r.mesh.triangles.size());
    }
  }
}

TEST(Build, TheCubesBoundaryIsMade) {
  const TetMesh mesh = build(test::kuhn_cube(4)).mesh;
  EXPECT_EQ(mesh.triangles.size(), 6u * 4 * 4 * 2);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const Vec3& p = mesh.points[v];
    const auto at_end = [](double x) { return x == 0 || x == 1; };
    EXPECT_EQ(mesh.vertex_tags[v], at_end(p.x) || at_end(p.y) || at_end(p.z) ? tag::kSurface : 0);
  }
}

TEST(Build, TurnsNegativeTets) {
  MeshData data = test::shuffled(test::kuhn_cube(3), 3);
  for (std::size_t t = 0; t < data.tets.size(); t += 5) std::swap(data.tets[t][0], data.tets[t][1]);
  const BuildResult r = build(data);
  EXPECT_EQ(r.summary.turned_tets, std::int64_t(data.tets.size() + 4) / 5);
  EXPECT_EQ(check(r.mesh).message(), "sound");
  EXPECT_EQ(r.summary.warnings().size(), 2u);
}

TEST(Build, DropsUnusedVertices) {
  MeshData data = test::two_tets();
  data.vertices.insert(data.vertices.begin() + 1, Vec3{7, 7, 7});
  data.vertex_refs = {10, 11, 12, 13, 14, 15};
  for (auto& tet : data.tets)
    for (auto& v : tet) v += v >= 1;
  data.sizes = {0.5, 9, 1, 1.5, 2, 2.5};
  data.corners = {1, 2};
  data.triangles = {{0, 1, 2}};
  data.triangle_refs = {8};
  data.edges = {{1, 2}};
  data.edge_refs = {3};
  const BuildResult r = build(data);
  EXPECT_EQ(r.summary.unused_vertices, 1);
  EXPECT_EQ(r.summary.dropped_triangles, 1);
  EXPECT_EQ(r.summary.dropped_edges, 1);
  EXPECT_EQ(r.mesh.vertex_refs, (std::vector<std::int32_t>{10, 12, 13, 14, 15}));
  EXPECT_EQ(r.mesh.sizes, (std::vector<float>{0.5, 1, 1.5, 2, 2.5}));
  EXPECT_EQ(r.mesh.vertex_tags[1], tag::kSurface | tag::kCorner | tag::kGiven);
  EXPECT_EQ(r.mesh.vertex_tags[2], tag::kSurface);
  EXPECT_EQ(check(r.mesh).message(), "sound");
}

/// Two tets on either side of a flat one over the square of the first four vertices; `flat` lists
/// the flat one's vertices.
MeshData flat_between(const std::array<std::int32_t, 4>& flat) {
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}};
  data.tets = {{0, 1, 2, 4}, {0, 2, 3, 4}, {1, 0, 3, 5}, {2, 1, 3, 5}, flat};
  return data;
}

TEST(Build, OrientsFlatTetsByTheirNeighbours) {
  std::array<std::int32_t, 4> flat = {0, 1, 2, 3};
  do {
    const BuildResult r = build(flat_between(flat));
    EXPECT_EQ(r.summary.flat_tets, 1);
    EXPECT_EQ(check(r.mesh, {.allow_flat_tets = true}).message(), "sound");
    EXPECT_EQ(check(r.mesh).count, 1);
    EXPECT_EQ(r.mesh.triangles.size(), 8u);
  } while (std::next_permutation(flat.begin(), flat.end()));
}

TEST(Build, RefusesAFlatTetThatItsNeighboursContradict) {
  // Both neighbours of the flat tet stand on what must be its two different sides.
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.6, 0.4, 1}, {0.6, 0.4, 2}};
  data.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}, {0, 1, 3, 5}};
  EXPECT_NE(build_error(data).find("on the same side"), std::string::npos);
}

TEST(Build, AcceptsAMeshOfFlatTetsOnly) {
  MeshData data = flat_between({0, 1, 2, 3});
  for (Vec3& p : data.vertices) p.z = 0;
  for (std::size_t t = 0; t < data.tets.size(); t += 2) std::swap(data.tets[t][1], data.tets[t][2]);
  const BuildResult r = build(data);
  EXPECT_EQ(r.summary.flat_tets, 5);
  EXPECT_EQ(check(r.mesh, {.allow_flat_tets = true}).message(), "sound");
}

TEST(BuildErrors, NoTets) { EXPECT_EQ(build_error(MeshData{}), "no tets"); }

TEST(BuildErrors, RepeatedVertex) {
  MeshData data = test::two_tets();
  data.tets[1][2] = 2;
  EXPECT_EQ(build_error(data), "tet 2 has vertex 3 twice");
}

TEST(BuildErrors, Coordinates) {
  for (const double x : {std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(), -1e101}) {
    for (int axis = 0; axis < 3; ++axis) {
      MeshData data = test::two_tets();
      (axis == 0 ? data.vertices[3].x : axis == 1 ? data.vertices[3].y : data.vertices[3].z) = x;
      const std::string text = build_error(data);
      EXPECT_EQ(text.find("vertex 4 has coordinates ("), 0u) << text;
      EXPECT_NE(text.find(x == -1e101 ? "too large" : "not finite"), std::string::npos) << text;
    }
  }
}

TEST(BuildErrors, Sizes) {
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e300, 1e-300}) {
    MeshData data = test::two_tets();
    data.sizes = {1, 1, size, 1, 1};
    const std::string text = build_error(data);
    EXPECT_EQ(text.find("the size of vertex 3 is "), 0u) << text;
  }
  MeshData data = test::two_tets();
  data.sizes = {1, 1};
  EXPECT_EQ(build_error(data), "2 sizes for 5 vertices");
}

TEST(BuildErrors, FaceInThreeTets) {
  MeshData data = test::two_tets();
  data.vertices.push_back({2, 2, 2});
  data.vertex_refs.push_back(0);
  data.tets.push_back({1, 2, 3, 5});
  data.tet_refs.push_back(1);
  EXPECT_EQ(build_error(data), "tets 1, 2 and 3 share one face");
}

TEST(BuildErrors, TwoTetsOnTheSameSide) {
  MeshData data = test::two_tets();
  data.vertices[4] = {0.1, 0.1, 0.1};
  EXPECT_EQ(build_error(data), "tets 1 and 2 lie on the same side of their common face");
}

TEST(BuildErrors, IndicesAndCounts) {
  const auto with = [](auto&& change) {
    MeshData data = test::two_tets();
    change(data);
    return build_error(data);
  };
  EXPECT_EQ(with([](MeshData& d) { d.tets[1][3] = 5; }),
            "tet 2 has vertex 6; there are 5 vertices");
  EXPECT_EQ(with([](MeshData& d) { d.tets[0][0] = -1; }),
            "tet 1 has vertex 0; there are 5 vertices");
  EXPECT_EQ(with([](MeshData& d) {
              d.triangles = {{0, 1, 9}};
            }),
            "triangle 1 has vertex 10; there are 5 vertices");
  EXPECT_EQ(with([](MeshData& d) {
              d.edges = {{0, 5}};
            }),
            "edge 1 has vertex 6; there are 5 vertices");
  EXPECT_EQ(with([](MeshData& d) { d.ridges = {0}; }), "ridge edge 1 is listed; there are 0");
  EXPECT_EQ(with([](MeshData& d) { d.corners = {5}; }), "corner vertex 6 is listed; there are 5");
  EXPECT_EQ(with([](MeshData& d) { d.required_tets = {2}; }),
            "required tet 3 is listed; there are 2");
  EXPECT_EQ(with([](MeshData& d) { d.tet_refs.pop_back(); }), "1 references for 2 tets");
}

TEST(Build, InterfacesBetweenReferences) {
  MeshData data = test::kuhn_cube(4);
  test::set_refs(data, [](const Vec3& p) { return p.x > 0.5 ? 3 : p.y > 0.5 ? 7 : 5; });
  const TetMesh mesh = build(data).mesh;
  EXPECT_EQ(check(mesh).message(), "sound");
  int interfaces = 0;
  for (const Triangle& s : mesh.triangles) {
    const std::int32_t ref = mesh.tet_refs[s.sides[0].tet()];
    EXPECT_EQ(s.ref, ref);
    if (!s.sides[1].is_tet()) continue;
    ++interfaces;
    EXPECT_LT(ref, mesh.tet_refs[s.sides[1].tet()]);
  }
  EXPECT_EQ(interfaces, 4 * 4 * 2 + 2 * 4 * 2);
}

TEST(Build, ListedTrianglesKeepOrderAndReference) {
  MeshData data = test::two_tets();
  data.tet_refs = {4, 2};
  // Exterior, interface the wrong way round, the exterior one again, and one that is no face.
  data.triangles = {{4, 2, 1}, {3, 2, 1}, {1, 2, 4}, {0, 1, 4}};
  data.triangle_refs = {21, 22, 23, 24};
  data.required_triangles = {0};
  const BuildResult r = build(data);
  EXPECT_EQ(check(r.mesh).message(), "sound");
  EXPECT_EQ(r.summary.dropped_triangles, 2);
  EXPECT_EQ(r.summary.made_triangles, 5);
  ASSERT_EQ(r.mesh.triangles.size(), 7u);
  EXPECT_EQ(r.mesh.triangles[0].ref, 21);
  EXPECT_EQ(r.mesh.triangles[0].tags, tag::kRequired);
  EXPECT_EQ(r.mesh.triangles[1].ref, 22);
  EXPECT_EQ(r.mesh.triangles[1].sides[0].tet(), 1);
  EXPECT_EQ(r.mesh.triangles[1].sides[1].tet(), 0);
  for (std::size_t i = 2; i < 7; ++i)
    EXPECT_TRUE(r.mesh.triangles[i].ref == 4 || r.mesh.triangles[i].ref == 2);
}

TEST(Build, DropsTrianglesInsideOneReference) {
  MeshData data = test::two_tets();
  data.triangles = {{1, 2, 3}};
  data.triangle_refs = {6};
  const BuildResult r = build(data);
  EXPECT_EQ(r.summary.dropped_triangles, 1);
  EXPECT_EQ(r.mesh.triangles.size(), 6u);
}

TEST(LinkFaces, LeavesTheBoundaryUnset) {
  TetMesh mesh = build(test::two_tets()).mesh;
  link_faces(mesh);
  EXPECT_EQ(mesh.links[0][0], FaceLink::to_tet(1, 3));
  for (int f = 1; f < 4; ++f) EXPECT_TRUE(mesh.links[0][f].is_unset());
}

TEST(AttachTriangles, RestoresWhatBuildMade) {
  for (const bool linked : {false, true}) {
    SCOPED_TRACE(linked ? "linked tets" : "unset links");
    MeshData data = test::shuffled(test::ball(4), 8);
    test::set_refs(data, [](const Vec3& p) { return p.z > 0 ? 1 : 2; });
    const TetMesh expected = build(data).mesh;
    TetMesh mesh = expected;
    Random random(31);
    for (Triangle& s : mesh.triangles) {
      s.sides = {};
      if (random.below(2) == 0) continue;
      std::swap(s.v[0], s.v[1]);
      std::swap(s.edge_tag[0], s.edge_tag[1]);
      std::swap(s.edge_ref[0], s.edge_ref[1]);
    }
    for (auto& links : mesh.links) links = {};
    if (linked) link_faces(mesh);
    attach_triangles(mesh);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
      EXPECT_EQ(mesh.triangles[i].sides, expected.triangles[i].sides);
    if (!linked) continue;
    EXPECT_EQ(mesh.links, expected.links);
    EXPECT_EQ(check(mesh).message(), "sound");
  }
}

TEST(AttachTriangles, RefusesWhatIsNoSurface) {
  const auto error_with = [](auto&& change) {
    TetMesh mesh = build(test::two_tets()).mesh;
    link_faces(mesh);
    change(mesh);
    return message_of<InternalError>([&] { attach_triangles(mesh); });
  };
  EXPECT_EQ(error_with([](TetMesh& m) {
              m.triangles[2].v = {1, 2, 3};
            }),
            "triangle 2 covers 0 faces of the surface");
  EXPECT_EQ(error_with([](TetMesh& m) { m.triangles.push_back(m.triangles[1]); }),
            "1 faces are covered by two triangles");
  EXPECT_EQ(error_with([](TetMesh& m) {
              for (auto& links : m.links) links = {};
              m.triangles[2].v = {1, 2, 3};
            }),
            "triangle 2 covers 2 faces of the surface");
}

}  // namespace
}  // namespace cavea
