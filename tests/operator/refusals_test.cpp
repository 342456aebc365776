// What the operators must refuse, asked of every edge and vertex of small meshes.
#include <functional>

#include "operator/stage.h"

namespace cavea::test {
namespace {

constexpr Tag kOnCurve = tag::kRidge | tag::kReferenceEdge | tag::kNonManifold;

/// The feature bits of the edge whose shell is at hand; 0 inside the volume.
Tag feature_of(const Stage& stage) {
  const Shell& s = stage.context.shell;
  for (const Shell::At& at : s.triangles) {
    const Triangle& t = stage.mesh.triangles[at.triangle];
    for (int k = 0; k < 3; ++k)
      if (t.v[k] != s.p && t.v[k] != s.q) return Tag(t.edge_tag[k] & tag::kFeature);
  }
  return 0;
}

/// Calls f(p, q) for each edge, both ways, with its shell gathered.
void for_each_edge_way(Stage& stage, const std::function<void(VertexId, VertexId)>& f) {
  for (const Edge& e : edges_of(stage.mesh))
    for (int way = 0; way < 2; ++way)
      if (stage.find_edge(e[std::size_t(way)], e[std::size_t(1 - way)]))
        f(e[std::size_t(way)], e[std::size_t(1 - way)]);
}

TEST(EdgeCollapse, NeverJoinsTwoSurfacesThroughTheVolume) {
  for (const Subject& subject : subjects()) {
    SCOPED_TRACE(subject.name);
    Stage stage(subject.data);
    int asked = 0;
    for_each_edge_way(stage, [&](VertexId p, VertexId q) {
      const Tag both = Tag(stage.mesh.vertex_tags[p] & stage.mesh.vertex_tags[q]);
      if (!(both & tag::kSurface) || stage.context.shell.on_surface()) return;
      ++asked;
      for (const bool for_quality : {false, true})
        EXPECT_NE(stage.collapse(for_quality), Verdict::kAccept) << p << " to " << q;
    });
    EXPECT_GT(asked, 0);
  }
}

/// Edges inside that the cavity at hand would bring to the surface.
int edges_that_come_up(Stage& stage) {
  const auto on_surface = [&](VertexId a, VertexId b) {
    return stage.find_edge(a, b) && stage.context.shell.on_surface();
  };
  int come = 0;
  for (const Triangle& t : stage.cavity.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId a = t.v[k], b = t.v[(k + 1) % 3];
      come += stage.find_edge(a, b) && !on_surface(a, b);
    }
  return come;
}

// Where a tet has two surface triangles, a vertex of the edge between them can vanish into one of
// the edge opposite: the tet goes, and that edge comes to the surface.
TEST(EdgeCollapse, BringsEdgesToTheSurfaceBelowTetsThatVanish) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Stage stage(shuffled(ball(12), seed));
    stage.context.limits.quality_ratio = 0;
    const Euler before = euler(stage.mesh);
    int found = 0;
    std::vector<Edge> edges = edges_of(stage.mesh);
    shuffle(edges, seed);
    for (const auto& [p, q] : edges) {
      if (!stage.find_edge(p, q) || !stage.context.shell.on_surface()) continue;
      if (stage.collapse() != Verdict::kAccept) continue;
      if (edges_that_come_up(stage) == 0) continue;
      stage.editor.commit(stage.cavity);
      ++found;
      expect_sound(stage.mesh);
    }
    EXPECT_GT(found, 10);
    EXPECT_EQ(euler(stage.mesh), before);
  }
}

TEST(EdgeCollapse, KeepsFeatureVerticesOnTheirCurvesAndCornersWhereTheyAre) {
  for (const Subject& subject : subjects()) {
    SCOPED_TRACE(subject.name);
    Stage stage(subject.data);
    stage.context.limits.quality_ratio = 0;
    int on_curve = 0, along = 0;
    for_each_edge_way(stage, [&](VertexId p, VertexId q) {
      const Tag tags = stage.mesh.vertex_tags[p];
      if (!(tags & (kOnCurve | tag::kCorner))) return;
      const bool accepted = stage.collapse() == Verdict::kAccept;
      ++on_curve;
      along += accepted;
      EXPECT_FALSE(accepted && (tags & tag::kCorner)) << p << " to " << q;
      EXPECT_FALSE(accepted && !feature_of(stage)) << p << " to " << q;
    });
    if (subject.polyhedral) {
      EXPECT_GT(on_curve, 0);
      EXPECT_GT(along, 0);
    }
  }
}

TEST(Refusals, FrozenVerticesStayWithAllTheirEdges) {
  constexpr std::uint64_t kSeed = 31;
  Random random(kSeed);
  Stage stage(kuhn_cube(4));
  for (Tag& tags : stage.mesh.vertex_tags)
    if (random.unit() < 0.5) tags |= tag::kFrozen;
  const auto frozen = [&](VertexId v) { return (stage.mesh.vertex_tags[v] & tag::kFrozen) != 0; };
  for_each_edge_way(stage, [&](VertexId p, VertexId q) {
    if (frozen(p)) {
      EXPECT_EQ(stage.collapse(), Verdict::kFrozen) << "seed " << kSeed;
    }
    if (!frozen(p) || !frozen(q)) return;
    EXPECT_EQ(stage.split(), Verdict::kFrozen) << "seed " << kSeed;
    EXPECT_EQ(stage.swap_edge(), Verdict::kFrozen) << "seed " << kSeed;
  });
  NewVertex to;
  for (std::size_t v = 0; v < stage.mesh.points.size(); ++v)
    if (frozen(VertexId(v))) {
      EXPECT_EQ(relocate(stage.context, VertexId(v), to), Verdict::kFrozen) << "seed " << kSeed;
    }
}

TEST(Refusals, RequiredVerticesAndCornersStay) {
  MeshData data = kuhn_cube(3);
  data.required_vertices = {0, 5, 21, 42};
  Stage stage(data);
  const auto fixed = [&](VertexId v) {
    return (stage.mesh.vertex_tags[v] & (tag::kRequired | tag::kCorner)) != 0;
  };
  for_each_edge_way(stage, [&](VertexId p, VertexId) {
    if (fixed(p)) {
      EXPECT_EQ(stage.collapse(), Verdict::kBreaksFeature);
    }
  });
  NewVertex to;
  int asked = 0;
  for (std::size_t v = 0; v < stage.mesh.points.size(); ++v)
    if (fixed(VertexId(v))) {
      ++asked;
      EXPECT_EQ(relocate(stage.context, VertexId(v), to), Verdict::kBreaksFeature);
    }
  EXPECT_GE(asked, 8 + 3);
}

TEST(Refusals, ARequiredTetStaysWhole) {
  MeshData data = kuhn_cube(3);
  data.required_tets = {70, 80};
  Stage stage(data);
  const auto required = [&](TetId t) {
    return (stage.mesh.tet_flags[t] & tet_flag::kRequired) != 0;
  };
  const auto removes_one = [&] {
    return std::any_of(stage.cavity.removed_tets.begin(), stage.cavity.removed_tets.end(),
                       required);
  };
  for_each_edge_way(stage, [&](VertexId, VertexId) {
    const std::vector<TetId> shell = stage.context.shell.tets;
    if (std::any_of(shell.begin(), shell.end(), required)) {
      EXPECT_NE(stage.split(), Verdict::kAccept);
      EXPECT_NE(stage.swap_edge(), Verdict::kAccept);
    }
    if (stage.collapse() == Verdict::kAccept) {
      EXPECT_FALSE(removes_one());
    }
  });
  for (std::size_t t = 0; t < stage.mesh.tets.size(); ++t)
    for (int f = 0; f < 4; ++f)
      if (face_swap(stage.context, TetId(t), f, stage.cavity) == Verdict::kAccept) {
        EXPECT_FALSE(removes_one());
      }
}

/// Two cells of a grid of cubes that have an edge (or, with `rise`, a vertex) in common and no
/// more.
MeshData touching_cells(bool rise) {
  return kuhn_grid(2, [=](int i, int j, int k) { return i == j && k == (rise ? i : 0); });
}

TEST(Refusals, WhereTheVolumeTouchesItselfItStaysAsItIs) {
  for (const bool rise : {false, true}) {
    Stage stage(touching_cells(rise));
    const auto pinched = [&](VertexId v) {
      return (stage.mesh.vertex_tags[v] & tag::kPinched) != 0;
    };
    int vertices = 0, edges = 0;
    NewVertex to;
    for (std::size_t v = 0; v < stage.mesh.points.size(); ++v)
      if (pinched(VertexId(v))) {
        ++vertices;
        EXPECT_NE(relocate(stage.context, VertexId(v), to), Verdict::kAccept);
      }
    for_each_edge_way(stage, [&](VertexId p, VertexId q) {
      if (pinched(p)) {
        EXPECT_NE(stage.collapse(), Verdict::kAccept);
      }
      if (!pinched(p) || !pinched(q)) return;
      ++edges;
      EXPECT_NE(stage.split(), Verdict::kAccept);
      EXPECT_NE(stage.swap_edge(), Verdict::kAccept);
    });
    EXPECT_EQ(vertices, rise ? 1 : 2);
    EXPECT_EQ(edges, rise ? 0 : 2);  // both ways
  }
}

TEST(EdgeSwap, LeavesAnEdgeOfOneTetAlone) {
  for (const MeshData& data : {single_tet(), kuhn_cube(3)}) {
    Stage stage(data);
    int asked = 0;
    for_each_edge_way(stage, [&](VertexId, VertexId) {
      if (stage.context.shell.tets.size() != 1) return;
      ++asked;
      EXPECT_NE(stage.swap_edge(), Verdict::kAccept);
    });
    EXPECT_GT(asked, 0);
  }
}

/// A cube with a tet over the diagonal of a square in the middle of its top, whose other corners
/// are raised by `height`: an ear over a valley. \return the cube; the diagonal first, then the
/// others
std::pair<MeshData, std::array<VertexId, 4>> cube_with_ear(double height) {
  MeshData data = kuhn_cube(3);
  const auto at = [&](double x, double y) {
    const Vec3 corner{x / 3, y / 3, 1};
    const auto found = std::ranges::find_if(
        data.vertices, [&](const Vec3& p) { return distance(p, corner) < 1e-9; });
    return VertexId(found - data.vertices.begin());
  };
  const std::array<VertexId, 4> v{at(1, 1), at(2, 2), at(1, 2), at(2, 1)};
  data.vertices[std::size_t(v[2])].z += height;
  data.vertices[std::size_t(v[3])].z += height;
  data.tets.push_back(v);
  data.tet_refs.push_back(1);
  return {data, v};
}

TEST(EdgeSwap, TakesAPoorEarOffTheSurface) {
  const auto [data, v] = cube_with_ear(0.01);
  Stage stage(data);
  stage.context.limits.ears_go = true;
  const std::int64_t tets = stage.editor.living_tets();
  ASSERT_TRUE(stage.find_edge(v[2], v[3]));
  ASSERT_EQ(stage.context.shell.tets.size(), 1u);
  ASSERT_EQ(stage.swap_edge(), Verdict::kAccept);
  stage.editor.commit(stage.cavity);
  expect_sound(stage.mesh);
  EXPECT_EQ(stage.editor.living_tets(), tets - 1);
  EXPECT_FALSE(stage.find_edge(v[2], v[3]));
  ASSERT_TRUE(stage.find_edge(v[0], v[1]));
  EXPECT_TRUE(stage.context.shell.on_surface());
}

TEST(EdgeSwap, LeavesEarsThatAreGoodOrTooHighOrOnTheirOwn) {
  // Good; farther than the tolerance from what would be left.
  for (const double height : {0.1, 0.045}) {
    const auto [data, v] = cube_with_ear(height);
    Stage stage(data);
    stage.context.limits.ears_go = true;
    ASSERT_TRUE(stage.find_edge(v[2], v[3])) << height;
    ASSERT_EQ(stage.context.shell.tets.size(), 1u) << height;
    EXPECT_NE(stage.swap_edge(), Verdict::kAccept) << height;
  }
  // A flat tet alone has more than two faces on the surface.
  MeshData flat = single_tet();
  for (Vec3& p : flat.vertices) p.z *= 0.01;
  Stage stage(flat);
  stage.context.limits.ears_go = true;
  for_each_edge_way(stage, [&](VertexId p, VertexId q) {
    EXPECT_NE(stage.swap_edge(), Verdict::kAccept) << p << ", " << q;
  });
}

TEST(EdgeSwap, LeavesFeatureEdgesAlone) {
  for (const Subject& subject : subjects()) {
    SCOPED_TRACE(subject.name);
    Stage stage(subject.data);
    for_each_edge_way(stage, [&](VertexId p, VertexId q) {
      if (feature_of(stage)) {
        EXPECT_NE(stage.swap_edge(), Verdict::kAccept) << p << ", " << q;
      }
    });
  }
}

TEST(FaceSwap, NeverCrossesTheSurfaceOrAnInterface) {
  Stage stage(subjects()[2].data);
  int asked = 0;
  for (std::size_t t = 0; t < stage.mesh.tets.size(); ++t)
    for (int f = 0; f < 4; ++f)
      if (stage.mesh.links[t][f].is_triangle()) {
        ++asked;
        EXPECT_EQ(face_swap(stage.context, TetId(t), f, stage.cavity), Verdict::kBreaksFeature);
      }
  EXPECT_GT(asked, 0);
}

}  // namespace
}  // namespace cavea::test
