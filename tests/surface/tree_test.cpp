#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "cavea/base/parallel.h"
#include "cavea/geometry/closest.h"
#include "cavea/surface/facet_tree.h"
#include "cavea/surface/patch_tree.h"
#include "surface/shapes.h"

namespace cavea {
namespace {

using test::Random;
using test::random_point;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Triangles of about this size, scattered over [-1, 1]^3.
std::vector<Corners> scattered(std::size_t n, double size, Random& random) {
  std::vector<Corners> triangles(n);
  for (Corners& t : triangles) {
    const Vec3 centre = random_point(random, -1, 1);
    for (Vec3& p : t) p = centre + random_point(random, -size, size);
  }
  return triangles;
}

double brute_force2(const Vec3& p, const std::vector<Corners>& triangles) {
  double best2 = kInfinity;
  for (const Corners& t : triangles)
    best2 = std::min(best2, closest_on_triangle(p, t[0], t[1], t[2]).distance2);
  return best2;
}

TEST(BoxTree, HoldsEachBoxOnceWhateverTheThreads) {
  for (const std::size_t n : {0u, 1u, 4u, 5u, 9u, 1000u, 12345u}) {
    Random random(n);
    std::vector<Box> boxes(n);
    for (Box& b : boxes) b.add(random_point(random, -1, 1));
    std::vector<std::int32_t> first;
    for (const int threads : {1, 3}) {
      run_in_arena(threads, [&] {
        const BoxTree tree(boxes);
        if (threads == 1)
          first = tree.order();
        else
          EXPECT_EQ(tree.order(), first) << n << " boxes";
      });
    }
    std::vector<std::int32_t> all(n);
    std::iota(all.begin(), all.end(), 0);
    std::sort(first.begin(), first.end());
    EXPECT_EQ(first, all);
  }
}

TEST(FacetTree, FindsWhatBruteForceFinds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const std::size_t n = 1 + std::size_t(random.below(400));
    const std::vector<Corners> triangles = scattered(n, random.between(0.01, 1), random);
    const FacetTree tree(triangles);
    NearestFacet last;
    for (int q = 0; q < 50; ++q) {
      const Vec3 p = random_point(random, -2, 2);
      const NearestFacet r = tree.nearest(p);
      ASSERT_GE(r.facet, 0);
      EXPECT_EQ(r.distance2, brute_force2(p, triangles));
      const Corners& t = triangles[r.facet];
      EXPECT_NEAR(distance2(p, (1 - r.u - r.v) * t[0] + r.u * t[1] + r.v * t[2]), r.distance2,
                  1e-13);
      last = tree.nearest_from(p, last);
      EXPECT_EQ(last.distance2, r.distance2);
    }
  }
}

TEST(FacetTree, FindsNothingBeyondTheBound) {
  Random random(5);
  const std::vector<Corners> triangles = scattered(100, 0.1, random);
  const FacetTree tree(triangles);
  for (int q = 0; q < 100; ++q) {
    const Vec3 p = random_point(random, -2, 2);
    const NearestFacet r = tree.nearest(p);
    EXPECT_EQ(tree.nearest(p, r.distance2).facet, kNone);
    EXPECT_EQ(tree.nearest(p, r.distance2 * 1.001).facet, r.facet);
  }
}

TEST(FacetTree, OfManyEqualTrianglesFindsOne) {
  const Corners t = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  const std::vector<Corners> triangles(100, t);
  const NearestFacet r = FacetTree(triangles).nearest({0.25, 0.25, 2});
  EXPECT_GE(r.facet, 0);
  EXPECT_EQ(r.distance2, 4);
}

TEST(FacetTree, OfNothingFindsNothing) {
  const NearestFacet r = FacetTree({}).nearest({0, 0, 0});
  EXPECT_EQ(r.facet, kNone);
  EXPECT_EQ(r.distance2, kInfinity);
}

/// The smallest distance of p from a lattice of n intervals on each patch of a model.
double sampled_distance(const Vec3& p, const SurfaceModel& model, int n) {
  double best2 = kInfinity;
  for (std::int32_t f = 0; f < std::int32_t(model.facets()); ++f)
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j)
        best2 =
            std::min(best2, distance2(p, model.patch_of_facet(f).at(double(i) / n, double(j) / n)));
  return std::sqrt(best2);
}

TEST(PatchTree, IsNearerThanAnySample) {
  // Bulges of a fifth of the facets' size: the nearest patch is often not that of the nearest
  // facet.
  const auto ball = test::modelled_ball(3);
  const PatchTree tree(ball.model);
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const Vec3 p = random.between(0.7, 1.5) * test::random_direction(random);
    const NearestOnModel r = tree.nearest(p);
    ASSERT_GE(r.facet, 0);
    EXPECT_EQ(r.place.distance2, distance2(r.place.point, p));
    EXPECT_EQ(r.place.point, ball.model.patch_of_facet(r.facet).at(r.place.u, r.place.v));
    const double sampled = sampled_distance(p, ball.model, 20);
    // The search ends when a step gains too little to matter.
    EXPECT_LE(std::sqrt(r.place.distance2), sampled * (1 + 1e-3) + 1e-9);
    EXPECT_GE(std::sqrt(r.place.distance2), sampled - 0.05);
  }
}

TEST(PatchTree, AHintDoesNotChangeTheDistance) {
  const auto ball = test::modelled_ball(6);
  const PatchTree tree(ball.model);
  Random random(11);
  NearestOnModel last;
  for (int q = 0; q < 500; ++q) {
    const Vec3 p = random.between(0.9, 1.1) * test::random_direction(random);
    last = tree.nearest(p, last);
    EXPECT_EQ(last.place.distance2, tree.nearest(p).place.distance2) << "seed 11, query " << q;
  }
}

TEST(ClosestOnPatch, OfAFlatPatchIsTheTriangles) {
  const auto cube = test::modelled_cube(1);
  Random random(2);
  for (std::int32_t f = 0; f < std::int32_t(cube.model.facets()); ++f)
    for (int q = 0; q < 20; ++q) {
      const auto [a, b, c] = cube.model.facet_corners(f);
      const Vec3 p = random_point(random, -1, 2);
      const ClosestOnTriangle flat = closest_on_triangle(p, a, b, c);
      const NearestOnPatch r = closest_on_patch(p, cube.model.patch_of_facet(f), 0.3, 0.3);
      EXPECT_NEAR(r.distance2, flat.distance2, 1e-12);
    }
}

}  // namespace
}  // namespace cavea
