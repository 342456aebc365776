// Where the domain is narrower than the wanted sizes, these give way in a few places, so that no
// tet stays unsound.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "cavea/mesh/copy.h"
#include "remesh/steps.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

constexpr double kSize = 0.05;

/// The step is too high to be joined, and far lower than the wanted size.
MeshData low_step() { return step(0.15 * kSize); }

/// Two walls that meet at an angle in degrees: no size makes good tets there.
MeshData wedge(double angle) {
  const double slope = std::tan(angle * std::numbers::pi / 180);
  return mapped(half_cube(4), [&](const Vec3& p) { return Vec3{p.x, slope * p.y, p.z}; });
}

Options options_of_size() {
  Options options = uniform(kSize);
  options.hausd = 0.02 * kSize;
  return options;
}

bool was_refined(const Report& report) { return times_of("refining", report) > 0; }

TEST(NarrowPlaces, UniformSizesGiveWayWhereRidgesAreNear) {
  TetMesh mesh = built(low_step());
  const Report report = remesh(mesh, {}, options_of_size());
  expect_sound(mesh);
  EXPECT_TRUE(was_refined(report));
  EXPECT_GE(report.after.quality.worst, 0.3);
  EXPECT_GE(report.after.lengths.conforming_percent(), 97);
  EXPECT_LE(report.surface_distance, *options_of_size().hausd);
  EXPECT_NEAR(report.after.counts.volume, report.before.counts.volume, 1e-9);
  const double smallest = *std::ranges::min_element(mesh.sizes);
  EXPECT_LT(smallest, 0.9 * kSize);
  EXPECT_GE(smallest, 0.029 * kSize);
}

/// Half the size is no help along a step that is much lower: there are only more poor tets. And of
/// a mesh of a few hundred tets those are many.
TEST(NarrowPlaces, MayNeedFarLessThanHalfTheSize) {
  for (const auto& [size, share] : {std::pair{0.2, 0.05}, {0.3, 0.05}, {0.25, 0.15}}) {
    SCOPED_TRACE(testing::Message() << "size " << size << ", step " << share << " of it");
    Options options = uniform(size);
    options.hausd = 0.02 * size;
    TetMesh mesh = built(step(share * size));
    const Report report = remesh(mesh, {}, options);
    expect_sound(mesh);
    EXPECT_GE(report.after.quality.worst, 0.3);
    EXPECT_NEAR(report.after.counts.volume, report.before.counts.volume, 1e-9);
    EXPECT_GE(*std::ranges::min_element(mesh.sizes), 0.029 * size);
  }
}

/// The default hmin is nobody's bound; a given one is kept.
TEST(NarrowPlaces, OfDefaultSizesGiveWayBelowHmin) {
  constexpr double kThickness = 0.06, kLargest = 0.015;  // so that few tets are at the step
  const double hmin = 0.001 * std::sqrt(1.25 + kThickness * kThickness);
  const MeshData body = mapped(step(0.2 * hmin), [](const Vec3& p) {
    return Vec3{p.x, p.y, kThickness * p.z};
  });
  Options options;
  options.hausd = 0.02 * hmin;
  options.hmax = kLargest;
  TetMesh mesh = built(body);
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_TRUE(was_refined(report));
  EXPECT_GE(report.after.quality.worst, 0.3);
  EXPECT_LT(*std::ranges::min_element(mesh.sizes), 0.9 * hmin);
  options.hmin = hmin;
  TetMesh bounded = built(body);
  remesh(bounded, {}, options);
  EXPECT_GE(*std::ranges::min_element(bounded.sizes), 0.99 * hmin);
}

TEST(NarrowPlaces, OfAResultStayAsTheyAre) {
  TetMesh mesh = built(low_step());
  remesh(mesh, {}, options_of_size());
  const TetMesh first = copy_of(mesh);
  const Report again = remesh(mesh, {}, options_of_size());
  EXPECT_GE(again.after.quality.worst, 0.3);
  EXPECT_TRUE(mesh.points == first.points);
  EXPECT_TRUE(mesh.tets == first.tets);
}

TEST(NarrowPlaces, WhatIsInVainIsTakenBack) {
  constexpr double kFine = 0.02;  // so that most tets are nowhere near the tip
  TetMesh mesh = built(wedge(8));
  const Report report = remesh(mesh, {}, uniform(kFine));
  expect_sound(mesh);
  EXPECT_TRUE(was_refined(report));
  EXPECT_LT(report.after.quality.worst, 0.3);
  EXPECT_GE(*std::ranges::min_element(mesh.sizes), 0.99 * kFine);
}

/// Between walls of so small an angle tets at their common edge are sound only if both have as many
/// vertices along it; above 13 degrees they can be.
TEST(NarrowPlaces, AtTheEdgeOfAWedgeAreTriedUntilTheyAreSound) {
  for (const double degrees : {14.0, 14.5, 15.0}) {
    SCOPED_TRACE(testing::Message() << degrees << " degrees");
    TetMesh mesh = built(wedge(degrees));
    const Report report = remesh(mesh, {}, {});
    expect_sound(mesh);
    EXPECT_GE(report.after.quality.worst, 0.3);
  }
}

TEST(NarrowPlaces, AreNotRefinedWhereFrozenOrSound) {
  EXPECT_FALSE(was_refined(report_of(kuhn_cube(4), options_of_size())));
  Options options = options_of_size();
  options.freeze.insert = true;
  EXPECT_FALSE(was_refined(report_of(low_step(), options)));
  options.freeze.insert = false, options.freeze.surface = true;
  EXPECT_FALSE(was_refined(report_of(low_step(), options)));
}

TEST(NarrowPlaces, AreTheSameAtAnyNumberOfThreads) {
  TetMesh first = built(low_step());
  remesh(first, {}, options_of_size());
  for (const int threads : {1, 2, 3, 8}) {
    Options options = options_of_size();
    options.threads = threads;
    TetMesh mesh = built(low_step());
    EXPECT_TRUE(was_refined(remesh(mesh, {}, options)));
    expect_same(mesh, first);
  }
}

}  // namespace
}  // namespace cavea::test
