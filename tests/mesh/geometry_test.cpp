#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cavea/geometry/dihedral.h"
#include "cavea/geometry/length_block.h"
#include "cavea/geometry/metric.h"
#include "cavea/geometry/predicates.h"
#include "cavea/geometry/quality.h"
#include "cavea/mesh/tet_mesh.h"
#include "support/meshes.h"

namespace cavea {
namespace {

using test::Random;

Vec3 random_point(Random& random) {
  return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

TEST(Orientation, FollowsTheRightHand) {
  const Vec3 o{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_EQ(orientation(o, x, y, z), 1);
  EXPECT_EQ(orientation(o, y, x, z), -1);
  EXPECT_EQ(orientation(o, x, y, x + y), 0);
  EXPECT_EQ(orientation(o, o, o, o), 0);
}

TEST(Orientation, SeesTheLastBitOfACoordinate) {
  // Four points on the plane x + y + z = 1.5, exact in binary, far from axis-parallel.
  const Vec3 a{0.5, 0.5, 0.5}, b{1.5, 0.25, -0.25}, c{-0.75, 1.75, 0.5};
  const Vec3 d{2.25, -1.5, 0.75};
  ASSERT_EQ(orientation(a, b, c, d), 0);
  const Vec3 up{d.x, d.y, std::nextafter(d.z, 10)}, down{d.x, d.y, std::nextafter(d.z, -10)};
  EXPECT_EQ(orientation(a, b, c, up), -orientation(a, b, c, down));
  EXPECT_NE(orientation(a, b, c, up), 0);
}

TEST(Orientation, OfAFlatTetIsZeroInAnyOrder) {
  // In one plane to the last bit, which the rounding of a 113-bit determinant hides.
  std::array<Vec3, 4> p = {{{-0x1.ddd25e46fa48cp-2, -0x1.3e8b880b5157cp-2, -0x1.4903050651374p-1},
                            {-0x1.8737602a6a146p-1, 0x1.1f92909a33b6p-2, 0x1.d30fb18cd7bep-3},
                            {0x1.4e54ba89d7dp-6, 0x1.9e677b5754018p-1, 0x1.02f3544eb98p-7},
                            {-0x1.71b7d151b2234p-2, 0x1.423b4ba3ed83ep-2, -0x1.f071aa1d1e99p-4}}};
  std::array<int, 4> k = {0, 1, 2, 3};
  do {
    EXPECT_EQ(orientation(p[k[0]], p[k[1]], p[k[2]], p[k[3]]), 0);
  } while (std::next_permutation(k.begin(), k.end()));
}

TEST(Orientation, CertainlyPositiveImpliesPositiveAndIsUsuallyTrue) {
  constexpr std::uint64_t kSeed = 11;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  Random random(kSeed);
  int positive = 0, certain = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random_point(random), b = random_point(random), c = random_point(random);
    // Every other one within rounding of the plane of a, b, c.
    const Vec3 d = i % 2 ? random_point(random) : a + 0.3 * (b - a) + 0.4 * (c - a);
    const int sign = orientation(a, b, c, d);
    EXPECT_EQ(orientation(b, a, c, d), -sign);
    EXPECT_EQ(orientation(b, c, a, d), sign);
    EXPECT_TRUE(sign == 1 || !certainly_positive(a, b, c, d));
    positive += i % 2 && sign > 0;
    certain += i % 2 && certainly_positive(a, b, c, d);
  }
  EXPECT_GT(positive, 400);
  EXPECT_EQ(certain, positive);
}

TEST(TetQuality, IsOneForTheRegularTetAndNegativeWhenInverted) {
  const std::vector<Vec3> p = test::single_tet().vertices;
  EXPECT_NEAR(tet_quality(p[0], p[1], p[2], p[3]), 1, 1e-14);
  EXPECT_NEAR(tet_quality(p[1], p[0], p[2], p[3]), -1, 1e-14);
  EXPECT_EQ(tet_quality(p[0], p[1], p[2], 0.5 * (p[1] + p[2])), 0);
  EXPECT_EQ(tet_quality(p[0], p[0], p[0], p[0]), 0);
}

TEST(TetQuality, DoesNotDependOnScaleAndIsHighestForTheRegularTet) {
  constexpr std::uint64_t kSeed = 12;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  Random random(kSeed);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 a = random_point(random), b = random_point(random), c = random_point(random),
               d = random_point(random);
    const double q = tet_quality(a, b, c, d);
    EXPECT_LE(std::abs(q), 1 + 1e-14);
    EXPECT_NEAR(tet_quality(1e6 * a, 1e6 * b, 1e6 * c, 1e6 * d), q, 1e-12);
  }
}

/// The integral of dl / h along the edge, by Simpson's rule.
double metric_length_by_quadrature(double length, double h0, double h1) {
  constexpr int kIntervals = 20000;
  double sum = 0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double h = h0 + (h1 - h0) * i / kIntervals;
    sum += (i == 0 || i == kIntervals ? 1 : i % 2 ? 4 : 2) / h;
  }
  return length * sum / (3 * kIntervals);
}

TEST(MetricLength, IsTheIntegralOfTheInverseSize) {
  for (const double ratio :
       {1.0, 1 + 1e-9, 1 + 1e-4, 0.9991, 1.0009, 1.0011, 0.5, 1.3, 4.0, 50.0}) {
    const double expected = metric_length_by_quadrature(0.7, 0.2, 0.2 * ratio);
    // Next to equal sizes the series is cut after its second term: 1e-3 cubed.
    EXPECT_NEAR(metric_length(0.7, 0.2, 0.2 * ratio), expected, 1e-9 * expected) << ratio;
    EXPECT_NEAR(metric_length(0.7, 0.2 * ratio, 0.2), expected, 1e-9 * expected) << ratio;
  }
}

TEST(EdgesByDihedral, AreAllSixByFallingAngle) {
  constexpr std::uint64_t kSeed = 7;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  Random random(kSeed);
  for (int i = 0; i < 1000; ++i) {
    std::array<Vec3, 4> x;
    for (Vec3& p : x) p = random_point(random);
    if (orientation(x[0], x[1], x[2], x[3]) <= 0) continue;
    const std::array<int, 6> order = edges_by_dihedral(x);
    auto angle = [&](int k) {
      const int* e = kEdgeVertices[order[std::size_t(k)]];
      return dihedral(x[std::size_t(e[0])], x[std::size_t(e[1])], x[std::size_t(e[2])],
                      x[std::size_t(e[3])]);
    };
    for (int k = 0; k + 1 < 6; ++k) EXPECT_GE(angle(k), angle(k + 1) - 1e-6);
    std::array<int, 6> all = order;
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, (std::array<int, 6>{0, 1, 2, 3, 4, 5}));
  }
}

TEST(EdgesByDihedral, OfAFlatTetAreAllSix) {
  std::array<int, 6> order = edges_by_dihedral({});
  std::sort(order.begin(), order.end());
  EXPECT_EQ(order, (std::array<int, 6>{0, 1, 2, 3, 4, 5}));
}

TEST(LengthBlock, LeavesOutOnlyWhatLengthsLeaveOut) {
  constexpr std::uint64_t kSeed = 11;
  constexpr double kLimit = 0.9;
  SCOPED_TRACE(testing::Message() << "seed " << kSeed);
  Random random{kSeed};
  constexpr std::size_t kEnds[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
  LengthBlock block;
  std::vector<std::array<Vec3, 4>> tets;
  std::vector<std::array<double, 4>> sizes;
  int left_out = 0, edges = 0;
  for (int round = 0; round < 20; ++round) {
    block.clear(), tets.clear(), sizes.clear();
    while (!block.full() && (round % 2 || tets.size() < 37)) {
      for (Vec3& p : tets.emplace_back())
        p = {random.between(0, 1), random.between(0, 1), random.between(0, 1)};
      for (double& h : sizes.emplace_back()) h = random.between(0.4, 1);
      block.add(tets.back(), sizes.back());
    }
    const LengthBlock::Edges above = block.perhaps_above(kLimit);
    const LengthBlock::Edges below = block.perhaps_below(kLimit);
    for (std::size_t i = 0; i < block.size(); ++i)
      for (std::size_t e = 0; e < 6; ++e, ++edges) {
        const std::size_t a = kEnds[e][0], b = kEnds[e][1];
        const bool is_above =
            length_exceeds(distance2(tets[i][a], tets[i][b]), sizes[i][a], sizes[i][b], kLimit);
        const bool may_be_above = above[i] >> e & 1, may_be_below = below[i] >> e & 1;
        EXPECT_TRUE(is_above ? may_be_above : may_be_below) << "edge " << e << " of tet " << i;
        left_out += !may_be_above || !may_be_below;
      }
  }
  EXPECT_GT(3 * left_out, edges);  // else it is of no use
}

}  // namespace
}  // namespace cavea
