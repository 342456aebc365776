#include "cavea/subdivide/subdivide.h"

#include <map>
#include <set>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/compact.h"
#include "subdivide/support.h"

namespace cavea::test {
namespace {

MeshData random_cube(int n, std::uint64_t seed) {
  MeshData data = kuhn_cube(n);
  perturb_inside(data, 0.1 / n, seed);
  set_refs(data, [](const Vec3& c) { return c.x + c.y < 0.9 ? 3 : 7; });
  return shuffled(data, seed);
}

TEST(Subdivide, MakesSoundMeshesOfRandomMarks) {
  const std::uint64_t first = std::random_device{}() % 1000000;
  for (std::uint64_t seed = first; seed < first + 24; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TetMesh mesh = build(random_cube(4, seed)).mesh;
    const TetMesh cut = subdivide(mesh, coin(seed, double(seed % 12) / 11), straight(mesh));
    expect_sound(cut);
    EXPECT_NEAR(volume(cut), volume(mesh), 1e-12);
    for (std::size_t t = 0; t < cut.tets.size(); ++t) {
      const auto [a, b, c, d] = cut.corners(TetId(t));
      ASSERT_TRUE(certainly_positive(a, b, c, d)) << "tet " << t;
    }
  }
}

TEST(Subdivide, MakesSoundMeshesOfPolycubes) {
  const std::uint64_t first = std::random_device{}() % 1000000;
  for (std::uint64_t seed = first; seed < first + 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TetMesh mesh = build(shuffled(polycube(4, 0.4, seed), seed)).mesh;
    expect_sound(subdivide(mesh, coin(seed, 0.5), straight(mesh)));
  }
}

TEST(Subdivide, AsksForEachEdgeOnce) {
  const TetMesh mesh = build(random_cube(3, 5)).mesh;
  std::set<std::pair<VertexId, VertexId>> expected, asked, placed;
  for (const auto& tet : mesh.tets)
    for (const auto& e : kEdgeVertices) expected.insert(std::minmax({tet[e[0]], tet[e[1]]}));
  auto note = [&](auto& set, const MeshEdge& e) {
    EXPECT_TRUE(set.insert({e.a, e.b}).second) << "asked twice";
    if (e.triangle == kNone) return;
    const auto& v = mesh.triangles[e.triangle].v;
    EXPECT_EQ(std::minmax({v[(e.side + 1) % 3], v[(e.side + 2) % 3]}), std::minmax({e.a, e.b}));
  };
  run_in_arena(1, [&] {
    subdivide(
        mesh,
        [&](const MeshEdge& e) {
          note(asked, e);
          return e.triangle != kNone;
        },
        [&](const MeshEdge& e) {
          note(placed, e);
          EXPECT_NE(e.triangle, kNone);
          return straight_midpoint(mesh, e);
        });
  });
  EXPECT_EQ(asked, expected);
  std::set<std::pair<VertexId, VertexId>> on_surface;
  for (const Triangle& s : mesh.triangles)
    for (int k = 0; k < 3; ++k) on_surface.insert(std::minmax({s.v[k], s.v[(k + 1) % 3]}));
  EXPECT_EQ(placed, on_surface);
}

TEST(Subdivide, LeavesAMeshWithoutMarksAsItIs) {
  const TetMesh mesh = build(random_cube(3, 9)).mesh;
  const TetMesh same = subdivide(
      mesh, [](const MeshEdge&) { return false; }, straight(mesh));
  expect_same(same, mesh);
}

TEST(Subdivide, IsTheSameAtAnyNumberOfThreads) {
  const TetMesh mesh = build(random_cube(12, 3)).mesh;
  // Thrown about, so that many vertices have to be drawn back.
  auto place = [&](const MeshEdge& e) {
    NewVertex made = straight_midpoint(mesh, e);
    Random random(std::uint64_t(e.a) * 100003 + std::uint64_t(e.b));
    made.point += Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)} * 0.05;
    return made;
  };
  TetMesh reference;
  run_in_arena(1, [&] { reference = subdivide(mesh, coin(1, 0.6), place); });
  for (const int threads : {2, 3, 8}) {
    TetMesh cut;
    run_in_arena(threads, [&] { cut = subdivide(mesh, coin(1, 0.6), place); });
    SCOPED_TRACE(std::to_string(threads) + " threads");
    expect_same(cut, reference);
  }
}

TEST(Subdivide, InheritsReferencesAndFlags) {
  TetMesh mesh = build(random_cube(3, 2)).mesh;
  for (auto& flags : mesh.tet_flags) flags = 0;
  mesh.tet_flags[0] = tet_flag::kRequired;
  const auto& kept = mesh.tets[0];
  auto split = [&](const MeshEdge& e) {  // all edges of no vertex of tet 0
    return std::find(kept.begin(), kept.end(), e.a) == kept.end() &&
           std::find(kept.begin(), kept.end(), e.b) == kept.end();
  };
  const TetMesh cut = subdivide(mesh, split, straight(mesh));
  std::map<int, double> before, after;
  auto add = [](std::map<int, double>& of_ref, const TetMesh& m) {
    for (std::size_t t = 0; t < m.tets.size(); ++t) {
      const auto [a, b, c, d] = m.corners(TetId(t));
      of_ref[m.tet_refs[t]] += volume6(a, b, c, d);
    }
  };
  add(before, mesh), add(after, cut);
  ASSERT_EQ(before.size(), 2u);
  for (const auto& [ref, volume] : before) EXPECT_NEAR(after[ref], volume, 1e-12);
  EXPECT_EQ(cut.tets[0], mesh.tets[0]);
  EXPECT_EQ(cut.tet_flags[0], tet_flag::kRequired);
  for (std::size_t t = 0; t < cut.tets.size(); ++t)
    for (const VertexId v : cut.tets[t])
      if (v >= VertexId(mesh.points.size())) {
        EXPECT_EQ(cut.tet_flags[t], tet_flag::kAskAll);
      }
}

/// Total length of the surface edges with the given tag and reference, each counted once a
/// triangle.
double tagged_length(const TetMesh& mesh, Tag bit, std::int32_t ref) {
  double sum = 0;
  for (const Triangle& s : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      if ((s.edge_tag[k] & bit) && s.edge_ref[k] == ref)
        sum += distance(mesh.points[s.v[(k + 1) % 3]], mesh.points[s.v[(k + 2) % 3]]);
  return sum;
}

TEST(Subdivide, HandsFeaturesToTheHalves) {
  MeshData data = kuhn_cube(3);
  auto on_axis = [&](std::int32_t v) { return data.vertices[v].y == 0 && data.vertices[v].z == 0; };
  for (std::int32_t a = 0; a < std::int32_t(data.vertices.size()); ++a)
    for (std::int32_t b = a + 1; b < std::int32_t(data.vertices.size()); ++b)
      if (on_axis(a) && on_axis(b) && distance(data.vertices[a], data.vertices[b]) < 0.4) {
        data.ridges.push_back(std::int32_t(data.edges.size()));
        data.edges.push_back({a, b});
        data.edge_refs.push_back(42);
      }
  ASSERT_EQ(data.edges.size(), 3u);
  TetMesh mesh = build(data).mesh;
  for (Triangle& s : mesh.triangles) s.ref = 5, s.patch = int(s.v[0] % 2);
  const TetMesh cut = subdivide(mesh, coin(8, 0.7), straight(mesh));
  expect_sound(cut);
  EXPECT_NEAR(tagged_length(mesh, tag::kRidge, 42), 2, 1e-12);
  EXPECT_NEAR(tagged_length(cut, tag::kRidge, 42), 2, 1e-12);
  double area[2] = {0, 0}, cut_area[2] = {0, 0};
  auto area_of = [](const TetMesh& m, const Triangle& s) {
    return norm(cross(m.points[s.v[1]] - m.points[s.v[0]], m.points[s.v[2]] - m.points[s.v[0]]));
  };
  for (const Triangle& s : mesh.triangles) area[s.patch] += area_of(mesh, s);
  for (const Triangle& s : cut.triangles) cut_area[s.patch] += area_of(cut, s);
  EXPECT_NEAR(cut_area[0], area[0], 1e-12);
  EXPECT_NEAR(cut_area[1], area[1], 1e-12);
  for (const Triangle& s : cut.triangles) EXPECT_EQ(s.ref, 5);
}

TEST(Subdivide, TakesSizesAndReferencesFromThePlacement) {
  TetMesh mesh = build(kuhn_cube(2)).mesh;
  for (float& size : mesh.sizes) size = 0.25f;
  mesh.sizes[0] = 0;
  const TetMesh cut = subdivide(mesh, every_edge, [&](const MeshEdge& e) {
    NewVertex made = straight_midpoint(mesh, e);
    EXPECT_EQ(made.size, 0.25f);  // the size of an end that has none does not count
    made.ref = 100 + e.a;
    made.anchor = {7, 0.5f, 0.25f};
    return made;
  });
  for (std::size_t v = mesh.points.size(); v < cut.points.size(); ++v) {
    EXPECT_GE(cut.vertex_refs[v], 100);
    EXPECT_EQ(cut.anchors[v].facet, 7);
    EXPECT_EQ(cut.sizes[v], 0.25f);
  }
}

TEST(Subdivide, ClosesHoles) {
  // Two cubes apart; the first one's entities are taken out and leave holes before the others.
  const MeshData data = kuhn_grid(3, [](int i, int, int) { return i != 1; });
  TetMesh mesh = build(data).mesh;
  auto first_cube = [&](VertexId v) { return mesh.points[v].x < 0.5; };
  for (auto& tet : mesh.tets)
    if (first_cube(tet[0])) tet = {kNone, kNone, kNone, kNone};
  for (Triangle& s : mesh.triangles)
    if (first_cube(s.v[0])) s.v = {kNone, kNone, kNone};
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
    if (first_cube(VertexId(v))) mesh.vertex_tets[v] = kNone;
  TetMesh dense = mesh;
  compact(dense);
  ASSERT_LT(dense.tets.size(), mesh.tets.size());
  auto by_place = [](const TetMesh& m) {
    return [&m](const MeshEdge& e) {
      return std::fmod(m.points[e.a].y + 2 * m.points[e.b].z, 1) < 0.6;
    };
  };
  const TetMesh cut = subdivide(mesh, by_place(mesh), straight(mesh));
  expect_sound(cut);
  EXPECT_GT(cut.tets.size(), dense.tets.size());
  expect_same(cut, subdivide(dense, by_place(dense), straight(dense)));
}

TEST(Subdivide, RefusesToSplitTheCutOfAPart) {
  TetMesh mesh = build(single_tet()).mesh;
  const TriangleId opened = mesh.links[0][3].triangle();
  mesh.links[0][3] = FaceLink::to_cut(12);
  mesh.triangles[opened].v = {kNone, kNone, kNone};
  const VertexId apex = mesh.tets[0][3];
  auto at_apex = [&](const MeshEdge& e) { return e.a == apex || e.b == apex; };
  const TetMesh cut = subdivide(mesh, at_apex, straight(mesh));
  int cuts = 0;
  for (const auto& links : cut.links)
    for (const FaceLink link : links) cuts += link == FaceLink::to_cut(12);
  EXPECT_EQ(cuts, 1);
  EXPECT_THROW(subdivide(mesh, every_edge, straight(mesh)), InternalError);
}

TEST(Subdivide, PassesOnWhatTheCallbacksThrow) {
  const TetMesh mesh = build(kuhn_cube(2)).mesh;
  auto cancel = [](const MeshEdge&) -> NewVertex { throw Cancelled(); };
  EXPECT_THROW(subdivide(mesh, every_edge, cancel), Cancelled);
}

}  // namespace
}  // namespace cavea::test
