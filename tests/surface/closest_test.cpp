#include "cavea/geometry/closest.h"

#include <gtest/gtest.h>

#include "surface/shapes.h"

namespace cavea {
namespace {

using test::Random;
using test::random_point;

Vec3 on_triangle(const std::array<Vec3, 3>& t, double u, double v) {
  return (1 - u - v) * t[0] + u * t[1] + v * t[2];
}

/// The smallest squared distance of p from a lattice on t; the true one is at most `spacing`
/// nearer.
double sampled_distance(const Vec3& p, const std::array<Vec3, 3>& t, int n, double& spacing) {
  double best2 = distance2(p, t[0]);
  for (int i = 0; i <= n; ++i)
    for (int j = 0; i + j <= n; ++j)
      best2 = std::min(best2, distance2(p, on_triangle(t, double(i) / n, double(j) / n)));
  spacing = std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])}) / n;
  return std::sqrt(best2);
}

void expect_closest(const Vec3& p, const std::array<Vec3, 3>& t) {
  const ClosestOnTriangle c = closest_on_triangle(p, t[0], t[1], t[2]);
  EXPECT_GE(c.u, 0);
  EXPECT_GE(c.v, 0);
  EXPECT_LE(c.u + c.v, 1 + 1e-12);
  EXPECT_NEAR(c.distance2, distance2(p, on_triangle(t, c.u, c.v)), 1e-14);
  double spacing = 0;
  const double sampled = sampled_distance(p, t, 40, spacing);
  EXPECT_LE(std::sqrt(c.distance2), sampled + 1e-12);
  EXPECT_GE(std::sqrt(c.distance2), sampled - spacing);
}

TEST(ClosestOnTriangle, IsNearerThanAnySample) {
  for (std::uint64_t seed = 1; seed <= 500; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    std::array<Vec3, 3> t;
    for (Vec3& x : t) x = random_point(random, -1, 1);
    expect_closest(random_point(random, -2, 2), t);
  }
}

TEST(ClosestOnTriangle, OfATriangleWithoutAreaIsOnItsLongestSide) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const Vec3 a = random_point(random, -1, 1), b = random_point(random, -1, 1);
    const Vec3 p = random_point(random, -2, 2);
    expect_closest(p, {a, b, (a + b) / 2});
    expect_closest(p, {a, a, b});
    expect_closest(p, {a, a, a});
  }
}

TEST(ClosestOnSegment, IsNearerThanAnySample) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const Vec3 a = random_point(random, -1, 1), b = random_point(random, -1, 1);
    const Vec3 p = random_point(random, -2, 2);
    const ClosestOnSegment c = closest_on_segment(p, a, b);
    EXPECT_NEAR(c.distance2, distance2(p, a + c.t * (b - a)), 1e-14);
    for (int i = 0; i <= 100; ++i)
      EXPECT_LE(c.distance2, distance2(p, a + i / 100.0 * (b - a)) + 1e-14);
  }
}

}  // namespace
}  // namespace cavea
