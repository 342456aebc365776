#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "cavea/geometry/closest.h"
#include "cavea/geometry/point_block.h"
#include "cavea/surface/distance.h"
#include "cavea/surface/facet_tree.h"
#include "cavea/surface/lattice.h"
#include "cavea/surface/patch_tree.h"
#include "surface/shapes.h"

namespace cavea {
namespace {

using test::Random;
using test::random_point;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// n points within `size` of a place; those that only fill the last group are far away.
PointBlock random_block(std::size_t n, const Vec3& place, double size, Random& random) {
  PointBlock points;
  points.resize(n);
  for (std::size_t i = 0; i < points.groups() * PointBlock::kGroup; ++i) {
    const Vec3 p = place + random_point(random, -size, size);
    points.x[i] = p.x, points.y[i] = p.y, points.z[i] = p.z;
  }
  return points;
}

/// The point with its coordinates rounded, so that it is on sides and at corners.
Vec3 on_grid(const Vec3& p) { return {std::round(2 * p.x), std::round(2 * p.y), 0}; }

/// Triangles of all sorts: of any shape, without area, on a grid.
Corners random_triangle(int sort, Random& random) {
  Corners t;
  for (Vec3& p : t) p = random_point(random, -1, 1);
  if (sort == 1) t[2] = (t[0] + t[1]) / 2;
  if (sort == 2) t[1] = t[0];
  if (sort == 3) t[1] = t[2] = t[0];
  if (sort == 4)
    for (Vec3& p : t) p = on_grid(p);
  return t;
}

TEST(PointBlock, ClosestOnTriangleIsThatOfEachPoint) {
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const int sort = random.below(5);
    const auto [a, b, c] = random_triangle(sort, random);
    const auto n = std::size_t(1 + random.below(int(PointBlock::kMost)));
    PointBlock points = random_block(n, {}, seed % 10 == 0 ? 1e9 : 2, random);
    for (std::size_t i = 0; sort == 4 && i < n; ++i) {
      const Vec3 p = on_grid(points[i]);
      points.x[i] = p.x, points.y[i] = p.y, points.z[i] = p.z;
    }
    ClosestOfBlock closest;
    closest_on_triangle(points, a, b, c, closest);
    for (std::size_t i = 0; i < n; ++i) {
      const ClosestOnTriangle one = closest_on_triangle(points[i], a, b, c);
      EXPECT_EQ(closest.u[i], one.u);
      EXPECT_EQ(closest.v[i], one.v);
      EXPECT_EQ(closest.distance2[i], one.distance2);
    }
  }
}

TEST(Lattice, HasEachPlaceInOneBlock) {
  const Lattices lattices;
  for (int n = Lattice::kMinIntervals; n <= Lattice::kMaxIntervals; ++n) {
    SCOPED_TRACE(n);
    const Lattice& lattice = lattices[n];
    EXPECT_EQ(lattice.intervals(), n);
    const auto has = [&](double u, double v) {
      return std::ranges::count_if(lattice.places(),
                                   [&](const auto& p) { return p.u == u && p.v == v; }) == 1;
    };
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i + j <= n; ++i) EXPECT_TRUE(has(double(i) / n, double(j) / n));
    for (const auto& p : lattices.coarsest().places()) EXPECT_TRUE(has(p.u, p.v));
    std::vector<int> seen(lattice.places().size(), 0);
    for (const Lattice::Block& block : lattice.blocks())
      for (std::size_t i = 0; i < block.count; ++i) {
        const auto p = std::size_t(block.place[i]);
        ++seen[p];
        EXPECT_EQ(block.u[i], lattice.places()[p].u);
        EXPECT_EQ(block.v[i], lattice.places()[p].v);
      }
    EXPECT_EQ(std::ranges::count(seen, 1), std::ptrdiff_t(seen.size()));
  }
}

TEST(Lattice, OfFewRowsHasThemAsFarApartAsThePlacesOfEach) {
  const Lattices lattices;
  for (const auto& [n, wanted] : {std::pair{64, 2}, {64, 5}, {64, 64}, {9, 3}, {2, 1}, {3, 1}}) {
    SCOPED_TRACE(testing::Message() << n << " intervals, " << wanted << " rows");
    const Lattice& lattice = lattices.with_rows(n, wanted);
    EXPECT_GE(lattice.rows(), std::min(std::max(wanted, 2), n));
    EXPECT_LT(lattice.rows(), std::max(2 * wanted + 2, 5));
    // A needle of that height over an edge of 1: from any point of it a place is near.
    const double across = double(wanted) / n;
    Random random(3);
    for (int k = 0; k < 200; ++k) {
      const double v = random.unit(), u = random.unit() * (1 - v);
      double nearest = 2;
      for (const auto& p : lattice.places())
        nearest = std::min(nearest, std::hypot(p.u + p.v / 2 - u - v / 2, (p.v - v) * across));
      EXPECT_LE(nearest, 1.0 / n);
    }
  }
}

TEST(BezierTriangle, PlacesOfABlockAreThoseOfEach) {
  const auto ball = test::modelled_ball(3);
  const Lattice lattice(13);
  for (std::int32_t f = 0; f < std::int32_t(ball.model.facets()); ++f)
    for (const Lattice::Block& block : lattice.blocks()) {
      const BezierTriangle& patch = ball.model.patch_of_facet(f);
      PointBlock points;
      patch.at(block.count, block.u, block.v, points);
      ASSERT_EQ(points.size(), block.count);
      for (std::size_t i = 0; i < block.count; ++i)
        EXPECT_EQ(points[i], patch.at(block.u[i], block.v[i]));
    }
}

TEST(FacetTree, FindsForABlockWhatItFindsForEachPointWithinReach) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    std::vector<Corners> triangles(std::size_t(1 + random.below(300)));
    for (Corners& t : triangles) {
      const Vec3 centre = random_point(random, -1, 1);
      for (Vec3& p : t) p = centre + random_point(random, -0.2, 0.2);
    }
    const FacetTree tree(triangles);
    const auto n = std::size_t(1 + random.below(int(PointBlock::kMost)));
    const PointBlock points = random_block(n, random_point(random, -1, 1), 0.1, random);
    const double reach = random.between(0, 0.4);
    const std::int32_t hint = seed % 2 ? kNone : random.below(int(triangles.size()));
    NearestOfBlock nearest;
    EXPECT_TRUE(tree.nearest(points, points.box(), hint, reach, -1, nearest));
    for (std::size_t i = 0; i < n; ++i) {
      const double truly = tree.nearest(points[i]).distance2;
      if (truly < reach * reach)
        EXPECT_EQ(nearest.distance2(i), truly);
      else
        EXPECT_GE(nearest.distance2(i), truly);
      if (nearest.number(i) == kNone) continue;
      const Corners& t = triangles[std::size_t(tree.triangle(nearest.number(i)))];
      EXPECT_EQ(closest_on_triangle(points[i], t[0], t[1], t[2]).distance2, nearest.distance2(i));
    }
  }
}

TEST(PatchTree, BoundsOfABlockAreAboveAndNear) {
  const auto ball = test::modelled_ball(5);
  const PatchTree tree(ball.model);
  const double bulge = measure_bulge(ball.model);
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const Vec3 place = random.between(0.95, 1.05) * test::random_direction(random);
    const PointBlock points = random_block(PointBlock::kMost, place, 0.05, random);
    constexpr double kReach = 0.2;  // all are nearer
    std::vector<std::int32_t> slots;
    tree.near(points.box(), kReach, slots);
    NearestOfBlock nearest;
    nearest.clear(points.size());
    for (const std::int32_t slot : slots) tree.improve(points, points.box(), slot, nearest);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double truly = std::sqrt(tree.nearest(points[i]).place.distance2);
      const double bound = std::sqrt(nearest.distance2(i));
      EXPECT_GE(bound, truly);
      EXPECT_LE(bound, truly + 0.2 * bulge);
    }
  }
}

/// The largest distance of the samples of all patches from all triangles, one by one.
double brute_force(const SurfaceModel& model, const std::vector<Corners>& triangles,
                   const Lattice& lattice) {
  double worst2 = 0;
  for (std::int32_t f = 0; f < std::int32_t(model.facets()); ++f)
    for (const auto& p : lattice.places()) {
      const Vec3 x = model.patch_of_facet(f).at(p.u, p.v);
      double best2 = kInfinity;
      for (const auto& [a, b, c] : triangles)
        best2 = std::min(best2, closest_on_triangle(x, a, b, c).distance2);
      worst2 = std::max(worst2, best2);
    }
  return std::sqrt(worst2);
}

/// The largest distance of the samples of all triangles from all patches, one by one.
double brute_force(const std::vector<Corners>& triangles, const SurfaceModel& model,
                   const Lattice& lattice) {
  double worst2 = 0;
  for (const auto& [a, b, c] : triangles)
    for (const auto& p : lattice.places()) {
      const Vec3 x = (1 - p.u - p.v) * a + p.u * b + p.v * c;
      double best2 = kInfinity;
      for (std::int32_t f = 0; f < std::int32_t(model.facets()); ++f) {
        const auto [fa, fb, fc] = model.facet_corners(f);
        const ClosestOnTriangle flat = closest_on_triangle(x, fa, fb, fc);
        best2 =
            std::min(best2, closest_on_patch(x, model.patch_of_facet(f), flat.u, flat.v).distance2);
      }
      worst2 = std::max(worst2, best2);
    }
  return std::sqrt(worst2);
}

TEST(SurfaceDistance, IsNoLessThanThatOfSamplesOneByOne) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random(seed);
    const auto ball = test::modelled_ball(2 + random.below(2));
    TetMesh mesh = test::modelled_ball(2 + random.below(3)).mesh;
    const double noise = random.between(0, 0.1);
    for (Vec3& p : mesh.points) p += random_point(random, -noise, noise);
    std::vector<Corners> triangles;
    double longest = 0;
    const auto add = [&](const Corners& t) {
      for (int k = 0; k < 3; ++k) longest = std::max(longest, distance(t[k], t[(k + 1) % 3]));
    };
    for (const Triangle& t : mesh.triangles) {
      triangles.push_back({mesh.points[t.v[0]], mesh.points[t.v[1]], mesh.points[t.v[2]]});
      add(triangles.back());
    }
    for (std::size_t f = 0; f < ball.model.facets(); ++f)
      add(ball.model.facet_corners(std::int32_t(f)));
    // Then all have the coarsest lattice, and some a few samples around the worst.
    const double step = 0.6 * longest;
    const Lattice coarsest(Lattice::kMinIntervals);
    for (const double enough : {0.0, 0.5}) {
      const SurfaceDistance d = measure_surface_distance(mesh, ball.model, step, kInfinity, enough);
      EXPECT_GE(d.model_to_out.max, brute_force(ball.model, triangles, coarsest));
      EXPECT_GE(d.out_to_model.max, brute_force(triangles, ball.model, coarsest));
      // Nothing is invented: the finest lattice nearly has as much.
      if (seed > 1) continue;
      const Lattice fine(12);
      EXPECT_LE(d.model_to_out.max, 1.02 * brute_force(ball.model, triangles, fine));
      EXPECT_LE(d.out_to_model.max, 1.02 * brute_force(triangles, ball.model, fine));
    }
  }
}

}  // namespace
}  // namespace cavea
