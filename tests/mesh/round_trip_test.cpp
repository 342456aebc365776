#include <gtest/gtest.h>

#include <algorithm>

#include "cavea/base/parallel.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/check.h"
#include "cavea/mesh/compact.h"
#include "support/meshes.h"

namespace cavea {
namespace {

/// A ball of two references with something in every list.
MeshData rich_ball(std::uint64_t seed) {
  MeshData data = test::shuffled(test::ball(4), seed);
  test::set_refs(data, [](const Vec3& p) { return p.x + p.y > 0.1 ? 4 : 6; });
  test::Random random(seed);
  for (auto& ref : data.vertex_refs) ref = random.below(5);
  const TetMesh mesh = build(data).mesh;
  for (const Triangle& s : mesh.triangles) {
    if (random.below(4) == 0)
      data.required_triangles.push_back(std::int32_t(data.triangles.size()));
    data.triangles.push_back(s.v);
    data.triangle_refs.push_back(random.below(3));
    const std::int32_t e = std::int32_t(data.edges.size());
    if (random.below(2)) data.ridges.push_back(e);
    if (random.below(5) == 0) data.required_edges.push_back(e);
    data.edges.push_back({s.v[0], s.v[1]});
    data.edge_refs.push_back(random.below(9));
  }
  data.corners = {1, 5};
  data.required_vertices = {0, 5};
  data.required_tets = {3, 40};
  return data;
}

void expect_same(const MeshData& a, const MeshData& b) {
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.vertex_refs, b.vertex_refs);
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.tet_refs, b.tet_refs);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.triangle_refs, b.triangle_refs);
  EXPECT_EQ(a.edges, b.edges);
  EXPECT_EQ(a.edge_refs, b.edge_refs);
  EXPECT_EQ(a.corners, b.corners);
  EXPECT_EQ(a.ridges, b.ridges);
  EXPECT_EQ(a.required_vertices, b.required_vertices);
  EXPECT_EQ(a.required_edges, b.required_edges);
  EXPECT_EQ(a.required_triangles, b.required_triangles);
  EXPECT_EQ(a.required_tets, b.required_tets);
  EXPECT_EQ(a.sizes, b.sizes);
}

TEST(RoundTrip, KeepsTheVolumeAndItsReferences) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const MeshData in = rich_ball(seed), out = to_data(build(in).mesh);
    EXPECT_EQ(out.vertices, in.vertices);
    EXPECT_EQ(out.vertex_refs, in.vertex_refs);
    EXPECT_EQ(out.tets, in.tets);
    EXPECT_EQ(out.tet_refs, in.tet_refs);
    EXPECT_EQ(out.triangle_refs, in.triangle_refs);
    EXPECT_EQ(out.corners, in.corners);
    EXPECT_EQ(out.required_triangles, in.required_triangles);
    EXPECT_EQ(out.required_tets, in.required_tets);
    EXPECT_TRUE(out.sizes.empty());
  }
}

TEST(RoundTrip, SecondTimeChangesNothing) {
  for (const std::uint64_t seed : {4, 5, 6}) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const MeshData once = to_data(build(rich_ball(seed)).mesh);
    EXPECT_FALSE(once.edges.empty() || once.ridges.empty() || once.required_edges.empty());
    const BuildResult again = build(once);
    EXPECT_EQ(check(again.mesh).message(), "sound");
    EXPECT_EQ(again.summary.made_triangles + again.summary.dropped_triangles +
                  again.summary.dropped_edges + again.summary.turned_tets,
              0);
    expect_same(to_data(again.mesh), once);
  }
}

TEST(RoundTrip, WritesSizesWhenAllAreKnown) {
  TetMesh mesh = build(test::two_tets()).mesh;
  mesh.sizes = {1, 2, 3, 4, 0};
  EXPECT_TRUE(to_data(mesh).sizes.empty());
  mesh.sizes[4] = 0.5f;
  EXPECT_EQ(to_data(mesh).sizes, (std::vector<double>{1, 2, 3, 4, 0.5}));
}

void expect_same(const TetMesh& a, const TetMesh& b) {
  expect_same(to_data(a), to_data(b));
  EXPECT_EQ(a.links, b.links);
  EXPECT_EQ(a.qualities, b.qualities);
  EXPECT_EQ(a.vertex_tets, b.vertex_tets);
  EXPECT_EQ(a.vertex_tags, b.vertex_tags);
  EXPECT_EQ(a.tet_flags, b.tet_flags);
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (std::size_t i = 0; i < a.triangles.size(); ++i) {
    EXPECT_EQ(a.triangles[i].sides, b.triangles[i].sides);
    EXPECT_EQ(a.triangles[i].edge_tag, b.triangles[i].edge_tag);
  }
}

TEST(Build, IsTheSameAtAnyNumberOfThreads) {
  MeshData data = test::shuffled(test::kuhn_cube(16), 7);
  test::set_refs(data, [](const Vec3& p) { return p.z > 0.4 ? 1 : 0; });
  for (std::size_t t = 0; t < data.tets.size(); t += 9) std::swap(data.tets[t][0], data.tets[t][1]);
  TetMesh alone;
  run_in_arena(1, [&] { alone = build(data).mesh; });
  for (const int threads : {2, 3, 8}) {
    TetMesh mesh;
    run_in_arena(threads, [&] { mesh = build(data).mesh; });
    expect_same(mesh, alone);
  }
}

/// `mesh` with holes: a new vertex, tet and triangle id before each old one of every third id.
TetMesh with_holes(const TetMesh& mesh) {
  const auto at = [](std::int32_t i) { return i + i / 3 + 1; };
  const auto link_at = [&](FaceLink link) {
    if (link.is_tet()) return FaceLink::to_tet(at(link.tet()), link.face());
    if (link.is_triangle()) return FaceLink::to_triangle(at(link.triangle()));
    return link;
  };
  TetMesh out;
  out.resize_vertices(std::size_t(at(std::int32_t(mesh.points.size()))));
  out.resize_tets(std::size_t(at(std::int32_t(mesh.tets.size()))));
  out.triangles.resize(std::size_t(at(std::int32_t(mesh.triangles.size()))));
  for (std::int32_t v = 0; v < std::int32_t(mesh.points.size()); ++v) {
    out.points[at(v)] = mesh.points[v];
    out.sizes[at(v)] = mesh.sizes[v];
    out.vertex_tags[at(v)] = mesh.vertex_tags[v];
    out.vertex_refs[at(v)] = mesh.vertex_refs[v];
    out.vertex_tets[at(v)] = at(mesh.vertex_tets[v]);
    out.anchors[at(v)] = mesh.anchors[v];
  }
  for (std::int32_t t = 0; t < std::int32_t(mesh.tets.size()); ++t) {
    for (int k = 0; k < 4; ++k) {
      out.tets[at(t)][k] = at(mesh.tets[t][k]);
      out.links[at(t)][k] = link_at(mesh.links[t][k]);
    }
    out.qualities[at(t)] = mesh.qualities[t];
    out.tet_refs[at(t)] = mesh.tet_refs[t];
    out.tet_flags[at(t)] = mesh.tet_flags[t];
  }
  for (std::int32_t i = 0; i < std::int32_t(mesh.triangles.size()); ++i) {
    Triangle& s = out.triangles[at(i)];
    s = mesh.triangles[i];
    for (VertexId& v : s.v) v = at(v);
    for (FaceLink& side : s.sides) side = link_at(side);
  }
  return out;
}

TEST(Compact, RemovesHolesAndKeepsTheOrder) {
  const TetMesh expected = build(rich_ball(9)).mesh;
  TetMesh mesh = with_holes(expected);
  ASSERT_GT(mesh.tets.size(), expected.tets.size());
  EXPECT_EQ(check(mesh).message(), "sound");
  expect_same(to_data(mesh), to_data(expected));
  compact(mesh);
  EXPECT_EQ(mesh.tets.size(), expected.tets.size());
  EXPECT_EQ(mesh.points.size(), expected.points.size());
  expect_same(mesh, expected);
  EXPECT_EQ(check(mesh).message(), "sound");
}

TEST(LinkFaces, SkipsHoles) {
  TetMesh mesh = with_holes(build(test::kuhn_cube(2)).mesh);
  const std::vector<std::array<FaceLink, 4>> links = mesh.links;
  link_faces(mesh);
  attach_triangles(mesh);
  EXPECT_EQ(mesh.links, links);
  EXPECT_EQ(check(mesh).message(), "sound");
}

}  // namespace
}  // namespace cavea
