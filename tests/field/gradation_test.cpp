// The gradation against its definition: the largest sizes below the given ones that rise no faster.
#include "cavea/field/gradation.h"

#include <cmath>
#include <limits>

#include "cavea/mesh/build.h"
#include "support/expect.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

constexpr double kFloat = 1e-6;

TetMesh random_sizes(std::uint64_t seed) {
  MeshData data = kuhn_cube(4);
  perturb_inside(data, 0.02, seed);
  Random random(seed);
  for (std::size_t v = 0; v < data.vertices.size(); ++v)
    data.sizes.push_back(std::exp(random.between(std::log(0.01), std::log(2))));
  return build(data).mesh;
}

/// Calls f(a, b, length) for each edge, both ways, once a tet.
template <class F>
void for_each_edge(const TetMesh& mesh, F&& f) {
  for (const auto& tet : mesh.tets)
    for (const auto& e : kEdgeVertices) {
      const VertexId a = tet[e[0]], b = tet[e[1]];
      const double length = distance(mesh.points[a], mesh.points[b]);
      f(a, b, length);
      f(b, a, length);
    }
}

/// Bellman and Ford's shortest ways, which the gradation is: the smallest of h(u) + slope |uv|.
std::vector<double> lowest(const TetMesh& mesh, std::vector<double> h, double slope) {
  for (bool again = true; again;) {
    again = false;
    for_each_edge(mesh, [&](VertexId a, VertexId b, double length) {
      if (h[a] + slope * length >= h[b]) return;
      h[b] = h[a] + slope * length;
      again = true;
    });
  }
  return h;
}

TEST(Gradation, GivesTheLargestSizesThatRiseNoFaster) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    TetMesh mesh = random_sizes(seed);
    const std::vector<double> expected =
        lowest(mesh, {mesh.sizes.begin(), mesh.sizes.end()}, std::log(1.3));
    limit_gradation(mesh, 1.3);
    for (std::size_t v = 0; v < expected.size(); ++v)
      EXPECT_NEAR(mesh.sizes[v], expected[v], kFloat);
  }
}

TEST(Gradation, WithoutBoundChangesNothing) {
  TetMesh mesh = random_sizes(1);
  const std::vector<float> before = mesh.sizes;
  limit_gradation(mesh, std::numeric_limits<double>::infinity());
  EXPECT_EQ(mesh.sizes, before);
}

TEST(Gradation, OfLoweredSizesIsThatOfAll) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    TetMesh mesh = random_sizes(seed);
    limit_gradation(mesh, 1.3);
    const std::vector<float> before = mesh.sizes;
    Random random(seed);
    for (float& size : mesh.sizes)
      if (random.unit() < 0.05) size *= float(random.between(0.2, 1));
    TetMesh anew = mesh;
    limit_gradation(anew, 1.3);
    limit_gradation_of_lowered(mesh, 1.3, before);
    for (std::size_t v = 0; v < before.size(); ++v) {
      EXPECT_NEAR(mesh.sizes[v], anew.sizes[v], kFloat);
      EXPECT_LE(mesh.sizes[v], before[v]);
    }
  }
}

TEST(Gradation, OfLoweredSizesLeavesWhatIsSteepElsewhere) {
  TetMesh mesh = random_sizes(1);
  const std::vector<float> before = mesh.sizes;
  limit_gradation_of_lowered(mesh, 1.3, before);
  EXPECT_EQ(mesh.sizes, before);
}

ImposedSizes impose_some(const TetMesh& mesh, std::uint64_t seed) {
  Random random(seed);
  ImposedSizes imposed{std::vector<float>(mesh.points.size(), 0), 2.3};
  for (float& size : imposed.sizes)
    if (random.unit() < 0.05) size = float(random.between(0.05, 0.5));
  return imposed;
}

TEST(Gradation, KeepsImposedSizesAndFollowsThemAround) {
  const double slope = std::log(1.3), steep = std::log(2.3);
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    TetMesh mesh = random_sizes(seed);
    const ImposedSizes imposed = impose_some(mesh, seed);
    std::vector<double> fallen;
    for (const float size : imposed.sizes) fallen.push_back(-size);
    fallen = lowest(mesh, fallen, steep);
    limit_gradation(mesh, 1.3, imposed);
    for (std::size_t v = 0; v < fallen.size(); ++v) {
      if (imposed.sizes[v] > 0)
        EXPECT_EQ(mesh.sizes[v], imposed.sizes[v]);
      else
        EXPECT_GE(mesh.sizes[v], -fallen[v] - kFloat);
    }
    for_each_edge(mesh, [&](VertexId a, VertexId b, double length) {
      if (imposed.sizes[b] > 0) return;
      const double rise = imposed.sizes[a] > 0 ? steep : slope;
      EXPECT_LE(mesh.sizes[b], std::max(mesh.sizes[a] + rise * length, -fallen[b]) + kFloat);
    });
  }
}

TEST(Gradation, RaisesOnlyAroundImposedSizes) {
  TetMesh mesh = build(kuhn_cube(4)).mesh;
  std::fill(mesh.sizes.begin(), mesh.sizes.end(), 0.1f);
  ImposedSizes imposed{std::vector<float>(mesh.points.size(), 0), 2.3};
  const VertexId corner = 0;
  imposed.sizes[corner] = 0.5f;
  limit_gradation(mesh, 1.3, imposed);
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const double far = distance(mesh.points[v], mesh.points[corner]);
    // Along the grid's edges a way is at most 1.2 times as long as the straight one.
    EXPECT_LE(mesh.sizes[v], std::max(0.1, 0.5 - std::log(2.3) * far) + kFloat);
    EXPECT_GE(mesh.sizes[v], std::max(0.1, 0.5 - std::log(2.3) * 1.2 * far) - kFloat);
  }
}

}  // namespace
}  // namespace cavea::test
