// The sizes that a mesh and its required entities have of themselves.
#include "cavea/field/own_sizes.h"

#include <algorithm>
#include <set>

#include "cavea/mesh/build.h"
#include "support/expect.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

constexpr double kFloat = 1e-6;

using Edges = std::set<std::pair<VertexId, VertexId>>;

double mean_at(const TetMesh& mesh, const Edges& edges, VertexId v) {
  double sum = 0;
  int n = 0;
  for (const auto& [a, b] : edges)
    if (a == v || b == v) sum += distance(mesh.points[a], mesh.points[b]), ++n;
  return n ? sum / n : 0;
}

template <std::size_t N>
void add_edges(Edges& edges, const std::array<VertexId, N>& v) {
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t j = i + 1; j < N; ++j) edges.insert(std::minmax(v[i], v[j]));
}

TEST(OwnSizes, AreTheMeanLengthsOfTheEdges) {
  const std::uint64_t seed = 5;
  MeshData data = kuhn_cube(3);
  perturb_inside(data, 0.03, seed);
  const TetMesh mesh = build(shuffled(data, seed)).mesh;
  Edges edges;
  for (const auto& tet : mesh.tets) add_edges(edges, tet);
  const SizeField field = own_sizes(mesh);
  for (VertexId v = 0; v < VertexId(mesh.points.size()); ++v)
    EXPECT_NEAR(field(mesh.points[v]), mean_at(mesh, edges, v), kFloat) << "seed " << seed;
}

std::int32_t vertex_at(const MeshData& data, const Vec3& place) {
  return std::int32_t(std::find(data.vertices.begin(), data.vertices.end(), place) -
                      data.vertices.begin());
}

TEST(RequiredSizes, AreThoseOfRequiredEntitiesAlone) {
  MeshData data = to_data(build(kuhn_cube(6)).mesh);
  EXPECT_TRUE(required_sizes(build(data).mesh).empty());
  data.required_vertices = {7};  // has no length
  EXPECT_TRUE(required_sizes(build(data).mesh).empty());
  data.required_triangles = {5, 6, 90};
  data.required_tets = {0, std::int32_t(data.tets.size()) - 1};
  data.edges = {{data.triangles[30][0], data.triangles[30][1]},
                {vertex_at(data, {0.5, 0.5, 0.5}), vertex_at(data, {4.0 / 6, 0.5, 0.5})}};
  data.edge_refs = {0, 0};
  data.required_edges = {0, 1};
  Edges edges;
  for (const std::int32_t t : data.required_triangles) add_edges(edges, data.triangles[t]);
  for (const std::int32_t t : data.required_tets) add_edges(edges, data.tets[t]);
  for (const auto& e : data.edges) add_edges(edges, e);
  const TetMesh mesh = build(data).mesh;
  const std::vector<float> sizes = required_sizes(mesh);
  ASSERT_EQ(sizes.size(), mesh.points.size());
  for (VertexId v = 0; v < VertexId(sizes.size()); ++v)
    EXPECT_NEAR(sizes[v], mean_at(mesh, edges, v), kFloat) << "vertex " << v;
}

}  // namespace
}  // namespace cavea::test
