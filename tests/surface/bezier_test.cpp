#include "cavea/surface/bezier.h"

#include <gtest/gtest.h>

#include "support/meshes.h"
#include "surface/shapes.h"

namespace cavea {
namespace {

using test::Random;
using test::random_point;

BezierTriangle random_patch(Random& random) {
  BezierTriangle p;
  for (Vec3& c : p.corner) c = random_point(random, -1, 1);
  for (auto& edge : p.edge)
    for (Vec3& c : edge) c = random_point(random, -1, 1);
  p.set_center();
  return p;
}

/// The cubic patch of the quadratic with these corners and edge points b_011, b_101, b_110.
BezierTriangle elevated(const std::array<Vec3, 3>& corner, const std::array<Vec3, 3>& middle) {
  BezierTriangle p;
  p.corner = corner;
  for (int k = 0; k < 3; ++k) {
    p.edge[k][0] = (corner[(k + 1) % 3] + 2 * middle[k]) / 3;
    p.edge[k][1] = (corner[(k + 2) % 3] + 2 * middle[k]) / 3;
  }
  p.set_center();
  return p;
}

constexpr double kRounding = 1e-14;

TEST(BezierTriangle, InterpolatesItsCornersAndEdges) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const BezierTriangle p = random_patch(random);
    EXPECT_LT(distance(p.at(0, 0), p.corner[0]), kRounding);
    EXPECT_LT(distance(p.at(1, 0), p.corner[1]), kRounding);
    EXPECT_LT(distance(p.at(0, 1), p.corner[2]), kRounding);
    const double t = random.unit();
    const auto edge = [&](int k) {
      return BezierCurve{
          {p.corner[(k + 1) % 3], p.edge[k][0], p.edge[k][1], p.corner[(k + 2) % 3]}};
    };
    EXPECT_LT(distance(p.at(1 - t, t), edge(0).at(t)), kRounding);
    EXPECT_LT(distance(p.at(0, 1 - t), edge(1).at(t)), kRounding);
    EXPECT_LT(distance(p.at(t, 0), edge(2).at(t)), kRounding);
  }
}

TEST(BezierTriangle, DerivativesAreThoseOfFiniteDifferences) {
  constexpr double h = 1e-5, kDifferenceError = 1e-8;  // h^2 times third derivatives of order 10
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const BezierTriangle p = random_patch(random);
    const double u = random.unit(), v = random.between(0, 1 - u);
    const auto [du, dv] = p.derivatives(u, v);
    EXPECT_LT(distance(du, (p.at(u + h, v) - p.at(u - h, v)) / (2 * h)), kDifferenceError);
    EXPECT_LT(distance(dv, (p.at(u, v + h) - p.at(u, v - h)) / (2 * h)), kDifferenceError);
    EXPECT_LT(distance(p.normal(u, v), cross(du, dv)), kRounding);
  }
}

TEST(BezierTriangle, CenterReproducesQuadratics) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    std::array<Vec3, 3> a, m;
    for (Vec3& x : a) x = random_point(random, -1, 1);
    for (Vec3& x : m) x = random_point(random, -1, 1);
    const BezierTriangle p = elevated(a, m);
    const double u = random.unit(), v = random.between(0, 1 - u), w = 1 - u - v;
    const Vec3 quadratic = w * w * a[0] + u * u * a[1] + v * v * a[2] + 2 * u * v * m[0] +
                           2 * v * w * m[1] + 2 * w * u * m[2];
    EXPECT_LT(distance(p.at(u, v), quadratic), kRounding);
  }
}

}  // namespace
}  // namespace cavea
