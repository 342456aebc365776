#include "cavea/partition/curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

std::vector<Vec3> random_points(unsigned seed, int n) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-3, 5);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    points.push_back({x, y, z / 10});
  }
  return points;
}

TEST(Curve, NamesOctreeCells) {
  const std::vector<Vec3> corners = {{0, 0, 0}, {0, 0, 8}, {0, 8, 0}, {0, 8, 8},
                                     {8, 0, 0}, {8, 0, 8}, {8, 8, 0}, {8, 8, 8}};
  const std::vector<std::uint64_t> keys = curve_keys(corners);
  for (std::uint64_t k = 0; k < 8; ++k) EXPECT_EQ(keys[k] >> 60, k);
  EXPECT_EQ(keys.front(), 0u);
  EXPECT_EQ(keys.back(), (std::uint64_t{1} << 63) - 1);
}

TEST(Curve, KeepsNeighboursTogether) {
  const std::vector<Vec3> points = random_points(2, 20000);
  auto path = [&](auto&& at) {
    double sum = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
      sum += distance(points[at(k - 1)], points[at(k)]);
    return sum;
  };
  const std::vector<std::uint64_t> keys = curve_keys(points);
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return keys[i]; });
  EXPECT_LT(path([&](std::size_t k) { return order[k]; }),
            0.1 * path([](std::size_t k) { return k; }));
}

TEST(Curve, BearsDegenerateInput) {
  EXPECT_TRUE(curve_keys({}).empty());
  const std::vector<Vec3> same(10, Vec3{1, 1, 1});
  EXPECT_EQ(curve_keys(same), std::vector<std::uint64_t>(10, 0));
  const std::vector<Vec3> bad = {{0, 0, 0}, {NAN, 1, 1}, {1, 1, 1}};
  const std::vector<std::uint64_t> keys = curve_keys(bad);
  EXPECT_LT(keys[0], keys[1]);
  EXPECT_LT(keys[1], keys[2]);
}

TEST(Curve, IsTheSameAtAnyNumberOfThreads) {
  const std::vector<Vec3> points = random_points(3, 100000);
  std::vector<std::uint64_t> reference;
  run_in_arena(1, [&] { reference = curve_keys(points); });
  for (const int threads : {2, 3, 8}) {
    std::vector<std::uint64_t> keys;
    run_in_arena(threads, [&] { keys = curve_keys(points); });
    EXPECT_EQ(keys, reference) << threads << " threads";
  }
}

}  // namespace
}  // namespace cavea
