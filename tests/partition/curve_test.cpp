#include "cavea/partition/curve.h"

#include <gtest/gtest.h>

#include <cmath>
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

TEST(Curve, OrdersByKeyThenIndex) {
  std::vector<Vec3> points = random_points(1, 5000);
  for (int i = 0; i < 500; ++i) points.push_back(points[i]);
  const std::vector<std::uint64_t> keys = curve_keys(points);
  const std::vector<std::int32_t> order = curve_order(points);
  ASSERT_EQ(order.size(), points.size());
  for (std::size_t k = 1; k < order.size(); ++k) {
    const auto a = order[k - 1], b = order[k];
    EXPECT_TRUE(keys[a] < keys[b] || (keys[a] == keys[b] && a < b));
  }
}

TEST(Curve, KeepsNeighboursTogether) {
  const std::vector<Vec3> points = random_points(2, 20000);
  auto path = [&](auto&& at) {
    double sum = 0;
    for (std::size_t k = 1; k < points.size(); ++k)
      sum += distance(points[at(k - 1)], points[at(k)]);
    return sum;
  };
  const std::vector<std::int32_t> order = curve_order(points);
  EXPECT_LT(path([&](std::size_t k) { return order[k]; }),
            0.1 * path([](std::size_t k) { return k; }));
}

TEST(Curve, BearsDegenerateInput) {
  EXPECT_TRUE(curve_order({}).empty());
  const std::vector<Vec3> same(10, Vec3{1, 1, 1});
  EXPECT_EQ(curve_order(same), (std::vector<std::int32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8, 9}));
  const std::vector<Vec3> bad = {{0, 0, 0}, {NAN, 1, 1}, {1, 1, 1}};
  EXPECT_EQ(curve_order(bad), (std::vector<std::int32_t>{0, 1, 2}));
}

TEST(Curve, IsTheSameAtAnyNumberOfThreads) {
  const std::vector<Vec3> points = random_points(3, 100000);
  std::vector<std::int32_t> reference;
  run_in_arena(1, [&] { reference = curve_order(points); });
  for (const int threads : {2, 3, 8}) {
    std::vector<std::int32_t> order;
    run_in_arena(threads, [&] { order = curve_order(points); });
    EXPECT_EQ(order, reference) << threads << " threads";
  }
}

}  // namespace
}  // namespace cavea
