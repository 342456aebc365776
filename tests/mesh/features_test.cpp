#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cavea/mesh/build.h"
#include "cavea/mesh/check.h"
#include "cavea/mesh/surface_edges.h"
#include "support/meshes.h"

namespace cavea {
namespace {

struct EdgeState {
  std::size_t triangles = 0;
  std::set<Tag> tags;
  std::set<std::int32_t> refs;
};

EdgeState edge_state(const TetMesh& mesh, VertexId a, VertexId b) {
  EdgeState out;
  const SurfaceEdges edges(mesh);
  for (const std::uint32_t use : edges.find(mesh, a, b)) {
    const auto [triangle, k] = SurfaceEdges::decode(use);
    ++out.triangles;
    out.tags.insert(mesh.triangles[triangle].edge_tag[k]);
    out.refs.insert(mesh.triangles[triangle].edge_ref[k]);
  }
  return out;
}

/// The vertex of kuhn_cube(n) at (x, y, z).
VertexId vertex_at(const TetMesh& mesh, const Vec3& p) {
  const auto at = std::find(mesh.points.begin(), mesh.points.end(), p);
  return at == mesh.points.end() ? kNone : VertexId(at - mesh.points.begin());
}

TEST(Features, ListedEdgesGetTheirTags) {
  MeshData data = test::two_tets();
  data.edges = {{0, 1}, {2, 0}, {0, 3}, {4, 1}, {0, 4}, {3, 3}, {1, 0}};
  data.edge_refs = {31, 32, 33, 34, 35, 36, 37};
  data.ridges = {0, 3};
  data.required_edges = {1, 3};
  const BuildResult r = build(data);
  const TetMesh& mesh = r.mesh;
  EXPECT_EQ(check(mesh).message(), "sound");
  EXPECT_EQ(r.summary.dropped_edges, 2);

  // Listed twice, the second time as no ridge: the first reference stays, the tags add up.
  EXPECT_EQ(edge_state(mesh, 0, 1).tags,
            std::set<Tag>{tag::kRidge | tag::kReferenceEdge | tag::kGiven});
  EXPECT_EQ(edge_state(mesh, 0, 1).refs, std::set<std::int32_t>{31});
  EXPECT_EQ(edge_state(mesh, 0, 2).tags, std::set<Tag>{tag::kRequired});
  EXPECT_EQ(edge_state(mesh, 0, 2).refs, std::set<std::int32_t>{32});
  EXPECT_EQ(edge_state(mesh, 0, 3).tags, std::set<Tag>{tag::kReferenceEdge});
  EXPECT_EQ(edge_state(mesh, 1, 4).tags,
            (std::set<Tag>{tag::kRidge | tag::kRequired | tag::kGiven}));
  EXPECT_EQ(edge_state(mesh, 1, 2).tags, std::set<Tag>{0});
  EXPECT_EQ(edge_state(mesh, 0, 1).triangles, 2u);

  EXPECT_EQ(mesh.vertex_tags[0],
            tag::kSurface | tag::kRidge | tag::kReferenceEdge | tag::kRequired);
  EXPECT_EQ(mesh.vertex_tags[1],
            tag::kSurface | tag::kRidge | tag::kReferenceEdge | tag::kRequired);
  EXPECT_EQ(mesh.vertex_tags[2], tag::kSurface | tag::kRequired);
  EXPECT_EQ(mesh.vertex_tags[3], tag::kSurface | tag::kReferenceEdge);
  EXPECT_EQ(mesh.vertex_tags[4], tag::kSurface | tag::kRidge | tag::kRequired);
}

TEST(Features, EdgesInsideTheVolume) {
  MeshData data = test::kuhn_cube(4);
  const TetMesh plain = build(data).mesh;
  const VertexId a = vertex_at(plain, {0.25, 0.25, 0.25}), b = vertex_at(plain, {0.5, 0.5, 0.5}),
                 c = vertex_at(plain, {0.75, 0.5, 0.5}), far = vertex_at(plain, {0.75, 0.75, 0.25});
  data.edges = {{b, a}, {b, c}, {a, far}};
  data.required_edges = {0, 2};
  const BuildResult r = build(data);
  EXPECT_EQ(check(r.mesh).message(), "sound");
  // One is not required, the other no edge at all.
  EXPECT_EQ(r.summary.dropped_edges, 2);
  EXPECT_EQ(r.mesh.vertex_tags[a], tag::kRequired | tag::kOnRequiredEdge);
  EXPECT_EQ(r.mesh.vertex_tags[b], tag::kRequired | tag::kOnRequiredEdge);
  EXPECT_EQ(r.mesh.vertex_tags[c], 0);
  EXPECT_EQ(r.mesh.vertex_tags[far], 0);
}

TEST(Features, EdgesBetweenReferencesOfTriangles) {
  MeshData data = test::single_tet();
  data.triangles = {{0, 1, 2}};
  data.triangle_refs = {50};
  const TetMesh mesh = build(data).mesh;
  EXPECT_EQ(check(mesh).message(), "sound");
  EXPECT_EQ(edge_state(mesh, 0, 1).tags, std::set<Tag>{tag::kReferenceEdge});
  EXPECT_EQ(edge_state(mesh, 0, 3).tags, std::set<Tag>{0});
  EXPECT_EQ(mesh.vertex_tags[3], tag::kSurface);
  EXPECT_EQ(mesh.vertex_tags[0], tag::kSurface | tag::kReferenceEdge);
}

TEST(Features, NonManifoldEdgesOfAPolycube) {
  // Two cells that touch along one edge: four triangles there.
  const MeshData data = test::kuhn_grid(
      2, [](int i, int j, int k) { return k == 0 && ((i == 0 && j == 0) || (i == 1 && j == 1)); });
  const TetMesh mesh = build(data).mesh;
  EXPECT_EQ(check(mesh).message(), "sound");
  const VertexId low = vertex_at(mesh, {0.5, 0.5, 0}), high = vertex_at(mesh, {0.5, 0.5, 0.5});
  EXPECT_EQ(edge_state(mesh, low, high).triangles, 4u);
  EXPECT_EQ(edge_state(mesh, low, high).tags, std::set<Tag>{tag::kNonManifold});
  for (VertexId v = 0; v < VertexId(mesh.points.size()); ++v)
    EXPECT_EQ(mesh.vertex_tags[v], tag::kSurface | (v == low || v == high ? tag::kNonManifold : 0));
}

TEST(Features, InterfacesMeetTheBoundaryInNonManifoldEdges) {
  MeshData data = test::two_tets();
  data.tet_refs = {1, 2};
  const TetMesh mesh = build(data).mesh;
  EXPECT_EQ(edge_state(mesh, 1, 2).triangles, 3u);
  EXPECT_EQ(edge_state(mesh, 1, 2).tags, (std::set<Tag>{tag::kNonManifold | tag::kReferenceEdge}));
  EXPECT_EQ(edge_state(mesh, 0, 2).tags, std::set<Tag>{0});
}

TEST(Features, RequiredTriangles) {
  MeshData data = test::two_tets();
  data.triangles = {{0, 1, 2}, {0, 2, 3}};
  data.triangle_refs = {1, 1};
  data.required_triangles = {1};
  const TetMesh mesh = build(data).mesh;
  EXPECT_EQ(check(mesh).message(), "sound");
  EXPECT_EQ(mesh.triangles[0].tags, 0);
  EXPECT_EQ(mesh.triangles[1].tags, tag::kRequired);
  for (const auto& [a, b] : {std::pair{0, 2}, {2, 3}, {3, 0}})
    EXPECT_EQ(edge_state(mesh, a, b).tags, std::set<Tag>{tag::kRequired});
  EXPECT_EQ(edge_state(mesh, 0, 1).tags, std::set<Tag>{0});
  for (const VertexId v : {0, 2, 3}) EXPECT_EQ(mesh.vertex_tags[v], tag::kSurface | tag::kRequired);
  EXPECT_EQ(mesh.vertex_tags[1], tag::kSurface);
}

TEST(Features, RequiredTetsAndVertices) {
  MeshData data = test::two_tets();
  data.required_tets = {1};
  data.required_vertices = {0};
  data.corners = {0, 4};
  const TetMesh mesh = build(data).mesh;
  EXPECT_EQ(mesh.tet_flags[0] & tet_flag::kRequired, 0);
  EXPECT_EQ(mesh.tet_flags[1], tet_flag::kAskAll | tet_flag::kRequired);
  EXPECT_EQ(mesh.vertex_tags[0], tag::kSurface | tag::kRequired | tag::kCorner | tag::kGiven);
  for (const VertexId v : {1, 2, 3})
    EXPECT_EQ(mesh.vertex_tags[v], tag::kSurface | tag::kRequired | tag::kOnRequiredEdge);
  EXPECT_EQ(mesh.vertex_tags[4],
            tag::kSurface | tag::kRequired | tag::kOnRequiredEdge | tag::kCorner | tag::kGiven);
}

}  // namespace
}  // namespace cavea
