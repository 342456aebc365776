#include "cavea/implicit/recovered_gradients.h"

#include <algorithm>
#include <cmath>

#include "cavea/implicit/cut.h"
#include "cavea/mesh/build.h"
#include "level_sets.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

bool is_inside(const Vec3& p) {
  return std::min({p.x, p.y, p.z}) > 0.01 && std::max({p.x, p.y, p.z}) < 0.99;
}

/// Calls f(a, b, zero) for the edges of tets whose ends have values of different signs.
template <class F>
void for_each_zero(const TetMesh& mesh, const std::vector<double>& values, F&& f) {
  const RecoveredGradients gradients(mesh, values);
  for (const auto& tet : mesh.tets)
    for (const auto& e : kEdgeVertices) {
      const VertexId a = tet[e[0]], b = tet[e[1]];
      if (values[a] * values[b] < 0) f(a, b, gradients.zero_on_edge(a, b));
    }
}

TEST(RecoveredGradients, AreThoseOfLinearFunctions) {
  const TetMesh cube = build(kuhn_cube(4)).mesh;
  const Vec3 slope{0.3, -2, 1.1};
  const auto values = values_of(cube, [&](const Vec3& p) { return dot(slope, p) + 0.21; });
  const RecoveredGradients gradients(cube, values);
  for (std::size_t v = 0; v < cube.points.size(); ++v)
    EXPECT_LT(norm(gradients.at(VertexId(v)) - slope), 1e-12);
  for_each_zero(cube, values, [&](VertexId a, VertexId b, double zero) {
    EXPECT_NEAR(zero, values[a] / (values[a] - values[b]), 1e-12);
  });
}

TEST(RecoveredGradients, FindTheZerosOfQuadraticFunctions) {
  const TetMesh cube = build(kuhn_cube(8)).mesh;
  const Function f = [](const Vec3& p) {
    return norm2(p - Vec3{0.47, 0.52, 0.5}) + p.x * p.y - 0.31;
  };
  int zeros = 0;
  for_each_zero(cube, values_of(cube, f), [&](VertexId a, VertexId b, double zero) {
    if (!is_inside(cube.points[a]) || !is_inside(cube.points[b])) return;
    ++zeros;
    EXPECT_NEAR(f(cube.points[a] + (cube.points[b] - cube.points[a]) * zero), 0, 1e-12);
  });
  EXPECT_GT(zeros, 100);
}

TEST(RecoveredGradients, StayOnTheEdgeWhateverTheValues) {
  const TetMesh cube = build(kuhn_cube(5)).mesh;
  for (int seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::uint64_t(seed)};
    const auto values = values_of(cube, [&](const Vec3&) {
      return random.between(-1, 1) * std::pow(10, random.between(-8, 8));
    });
    for_each_zero(cube, values, [&](VertexId, VertexId, double zero) {
      EXPECT_GE(zero, 0);
      EXPECT_LE(zero, 1);
    });
  }
}

TEST(RecoveredGradients, DoNotSmoothKinks) {
  const TetMesh cube = build(kuhn_cube(10)).mesh;
  const Function box = [](const Vec3& p) {
    return std::max({std::abs(p.x - 0.5), std::abs(p.y - 0.5), std::abs(p.z - 0.5)}) - 0.27;
  };
  const auto values = values_of(cube, box);
  double farthest = 0;
  for_each_zero(cube, values, [&](VertexId a, VertexId b, double zero) {
    const double linear = values[a] / (values[a] - values[b]);
    farthest = std::max(farthest, std::abs(zero - linear));
  });
  EXPECT_LT(farthest, 0.1);  // of an edge, where it is linear but for kinks in mid-edge
}

TEST(RecoveredGradients, MakeACutOfValuesAsRoundAsOneOfTheFunction) {
  const TetMesh cube = build(kuhn_cube(12)).mesh;
  double farthest = 0;
  const TetMesh cut = cut_along(cube, values_of(cube, sphere)).mesh;
  for (const Triangle& s : cut.triangles)
    for (const VertexId v : s.v)
      if (s.ref == 10) farthest = std::max(farthest, std::abs(sphere(cut.points[v])));
  // Where the function is linear on edges they are off by this.
  const double linear = 3.0 / (12 * 12) / 8 / 0.3;
  EXPECT_LT(farthest, linear / 4);  // most of it from vertices that are put on the interface
}

}  // namespace
}  // namespace cavea::test
