#include "cavea/surface/distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numbers>
#include <random>

#include "cavea/base/parallel.h"
#include "cavea/surface/facet_tree.h"
#include "cavea/surface/patch_tree.h"
#include "surface/shapes.h"

namespace cavea {
namespace {

using test::modelled_ball;
using test::modelled_cube;

constexpr double kStep = 0.02;

/// Largest distance of patch points from the facet points of the same coordinates.
double largest_offset(const SurfaceModel& model) {
  constexpr int n = 96;
  double worst = 0;
  for (std::int32_t f = 0; f < std::int32_t(model.facets()); ++f) {
    const auto [a, b, c] = model.facet_corners(f);
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const double u = double(i) / n, v = double(j) / n;
        worst = std::max(
            worst, distance(model.patch_of_facet(f).at(u, v), (1 - u - v) * a + u * b + v * c));
      }
  }
  return worst;
}

TEST(OffsetBound, IsAboveAllOffsetsAndNearTheLargest) {
  for (const int cells : {3, 6, 12}) {
    const auto ball = modelled_ball(cells);
    double bound = 0;
    for (std::int32_t f = 0; f < std::int32_t(ball.model.facets()); ++f)
      bound = std::max(bound, offset_bound(ball.model.patch_of_facet(f)));
    EXPECT_GE(bound, largest_offset(ball.model));
    EXPECT_LE(bound, 2 * largest_offset(ball.model));
  }
}

TEST(SurfaceDistance, OfTheInputIsItsBulge) {
  const auto ball = modelled_ball(6);
  const SurfaceDistance d = measure_surface_distance(ball.mesh, ball.model, kStep);
  const double bulge = measure_bulge(ball.model);
  EXPECT_GT(bulge, 0.005);
  EXPECT_NEAR(d.model_to_out.max, bulge, 0.02 * bulge);
  EXPECT_LE(d.out_to_model.max, largest_offset(ball.model) * (1 + 1e-4));  // sampled, too
  EXPECT_NEAR(d.out_to_model.max, bulge, 0.02 * bulge);
  EXPECT_LT(d.out_to_model.mean, d.out_to_model.max);
  EXPECT_GT(d.out_to_model.mean, 0);
}

TEST(SurfaceDistance, OfTheInputIsTheSameWhereBoundsAreKnownWithoutSamples) {
  const auto ball = modelled_ball(14);
  const double none = std::numeric_limits<double>::infinity();
  const SurfaceDistance all = measure_surface_distance(ball.mesh, ball.model, kStep);
  const double most = 0.7 * all.worse().worst;
  const SurfaceDistance listed = measure_surface_distance(ball.mesh, ball.model, kStep, most);
  EXPECT_GT(listed.far_facets.size(), 100u);
  for (const double share : {0.05, 0.3, 0.6, 0.99}) {
    SCOPED_TRACE(share);
    const double enough = share * all.worse().worst;
    const SurfaceDistance d = measure_surface_distance(ball.mesh, ball.model, kStep, none, enough);
    EXPECT_EQ(d.out_to_model.max, all.out_to_model.max);
    EXPECT_EQ(d.model_to_out.max, all.model_to_out.max);
    const SurfaceDistance far =
        measure_surface_distance(ball.mesh, ball.model, kStep, most, enough);
    EXPECT_EQ(far.far_facets.size(), listed.far_facets.size());
  }
}

TEST(SurfaceDistance, IsFoundBetweenSamples) {
  // The pole of a bump is anywhere on a facet that is much larger.
  constexpr std::uint64_t kSeed = 5;
  constexpr double kHeight = 0.01;
  test::Random random(kSeed);
  for (int k = 0; k < 20; ++k) {
    SCOPED_TRACE(testing::Message() << "seed " << kSeed << ", bump " << k);
    const auto cube = modelled_cube(1);
    TetMesh finer = build(test::kuhn_cube(9)).mesh;
    const Vec3 pole{random.between(0.2, 0.8), random.between(0.2, 0.8), 0};
    for (Vec3& p : finer.points)
      if (p.z == 0) p.z = kHeight / (1 + 30 * distance2(p, pole));
    const SurfaceDistance fine = measure_surface_distance(finer, cube.model, kStep / 2);
    const SurfaceDistance coarse = measure_surface_distance(finer, cube.model, 12 * kStep);
    EXPECT_GT(coarse.model_to_out.max, 0.96 * fine.model_to_out.max);
  }
}

/// As where a blade's fold was cut. The samples beside the notch are 0.67 (k = 6, 18) and 0.89 of
/// the tolerance away, and on an edge that leads to the apex of their lattice.
TEST(SurfaceDistance, ANotchInAnEdgeIsFoundBetweenSamplesThatAreNear) {
  constexpr double kDepth = 0.01, kFarthest = 0.9724 * kDepth;  // of the edge, from the notch
  constexpr double kHausd = kFarthest / 1.11, kLongest = 1.001 * std::numbers::sqrt2 / 30;
  const TetMesh whole = build(test::kuhn_cube(24)).mesh;
  TetMesh cube = build(test::kuhn_cube(1)).mesh;
  classify_features(cube, {});
  const SurfaceModel model(cube, {kHausd, kHausd, 0.001, 10});
  for (const int k : {3, 6, 18, 21}) {
    SCOPED_TRACE(k);
    TetMesh notched = whole;
    for (Vec3& p : notched.points)
      if (distance(p, {k / 24., 0, 1}) < 1e-9)
        p = p + kDepth / std::numbers::sqrt2 * Vec3{0, 1, -1};
    DistanceMeter meter(model, {{0.1 * kLongest, kLongest}, 0.95, 0.5});
    const SurfaceDistance d = meter.measure(notched);
    EXPECT_GT(d.model_to_out.worst, 1.05);
    EXPECT_FALSE(d.far_facets.empty());
  }
}

TEST(SurfaceDistance, OfAFlatShapeIsZero) {
  const auto cube = modelled_cube(2);
  const TetMesh finer = build(test::kuhn_cube(5)).mesh;
  const SurfaceDistance d = measure_surface_distance(finer, cube.model, kStep, 1e-9);
  EXPECT_LT(d.max(), 1e-15);
  EXPECT_LT(measure_bulge(cube.model), 1e-15);
  EXPECT_TRUE(d.far_triangles.empty());
  EXPECT_TRUE(d.far_facets.empty());
}

TEST(SurfaceDistance, OfAShiftedBallIsTheShift) {
  const auto ball = modelled_ball(10);
  TetMesh shifted = ball.mesh;
  constexpr double kShift = 0.2;
  for (Vec3& p : shifted.points) p.x += kShift;
  const SurfaceDistance d = measure_surface_distance(shifted, ball.model, kStep);
  EXPECT_NEAR(d.out_to_model.max, kShift, 0.005);
  EXPECT_NEAR(std::abs(d.out_to_model.where.x - kShift), 1, 0.01);
  EXPECT_NEAR(d.model_to_out.max, kShift, 0.005);
  EXPECT_NEAR(std::abs(d.model_to_out.where.x), 1, 0.01);
  // The mean of |cos| over the sphere is a half.
  EXPECT_NEAR(d.out_to_model.mean, kShift / 2, 0.005);
}

TEST(SurfaceDistance, OfASmallerBallIsTheDifferenceOfTheRadii) {
  const auto ball = modelled_ball(8);
  TetMesh smaller = modelled_ball(12).mesh;
  for (Vec3& p : smaller.points) p *= 0.9;
  const SurfaceDistance d = measure_surface_distance(smaller, ball.model, kStep);
  EXPECT_NEAR(d.out_to_model.max, 0.1, 0.01);
  EXPECT_NEAR(d.out_to_model.mean, 0.1, 0.005);
  EXPECT_NEAR(d.model_to_out.max, 0.1, 0.01);
}

/// The cube of 5^3 cells without its middle cell of one face: out is wrong where the model is
/// missed.
TEST(SurfaceDistance, SeesWhatIsLostFromBothSides) {
  const auto cube = modelled_cube(5);
  const TetMesh dented = build(test::kuhn_grid(5, [](int i, int j, int k) {
                           return !(i == 2 && j == 2 && k == 4);
                         })).mesh;
  const SurfaceDistance d = measure_surface_distance(dented, cube.model, kStep, 50);
  EXPECT_NEAR(d.out_to_model.max, 0.2, 1e-12);
  EXPECT_NEAR(d.out_to_model.where.z, 0.8, 1e-12);
  EXPECT_NEAR(d.model_to_out.max, 0.1, 1e-12);
  EXPECT_NEAR(distance(d.model_to_out.where, {0.5, 0.5, 1}), 0, 1e-12);
  // Walls and floor of the dent; the lid's two facets.
  EXPECT_EQ(d.far_triangles.size(), 10u);
  EXPECT_EQ(d.far_facets.size(), 2u);
}

TEST(SurfaceDistance, ListsWhatIsBeyondTheTolerance) {
  const auto cube = modelled_cube(3);
  TetMesh mesh = cube.mesh;
  const auto moved = std::size_t(std::find_if(mesh.points.begin(), mesh.points.end(),
                                              [](const Vec3& p) {
                                                return p.z == 1 && p.x > 0.3 && p.x < 0.4 &&
                                                       p.y > 0.6 && p.y < 0.7;
                                              }) -
                                 mesh.points.begin());
  ASSERT_LT(moved, mesh.points.size());
  mesh.points[moved].z = 1.1;
  std::vector<TriangleId> around;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (std::ranges::count(mesh.triangles[t].v, VertexId(moved))) around.push_back(TriangleId(t));
  const SurfaceDistance d = measure_surface_distance(mesh, cube.model, kStep, 10);
  ASSERT_EQ(d.far_triangles.size(), around.size());
  for (std::size_t i = 0; i < around.size(); ++i) {
    EXPECT_EQ(d.far_triangles[i].id, around[i]);
    EXPECT_NEAR(d.far_triangles[i].distance, 0.1, 1e-12);
    EXPECT_EQ(d.far_triangles[i].where, mesh.points[moved]);
  }
}

TEST(SurfaceDistance, SkipsHoles) {
  const auto cube = modelled_cube(2);
  TetMesh mesh = cube.mesh;
  mesh.triangles[0].v = {kNone, kNone, kNone};
  const SurfaceDistance d = measure_surface_distance(mesh, cube.model, kStep, 10);
  EXPECT_LT(d.out_to_model.max, 1e-15);
  // The facet is the only one that the mesh misses.
  ASSERT_EQ(d.far_facets.size(), 1u);
  EXPECT_EQ(d.far_facets[0].id, 0);
}

TEST(SurfaceDistance, FromNothingIsInfinite) {
  const auto cube = modelled_cube(1);
  const SurfaceDistance d = measure_surface_distance(TetMesh{}, cube.model, kStep);
  EXPECT_EQ(d.model_to_out.max, std::numeric_limits<double>::infinity());
  EXPECT_EQ(d.out_to_model.max, 0);
}

TEST(SurfaceDistance, AFinerStepFindsAtLeastAlmostAsMuch) {
  const auto ball = modelled_ball(4);
  const TetMesh coarse = modelled_ball(3).mesh;
  const double fine = measure_surface_distance(coarse, ball.model, 0.02).max();
  const double rough = measure_surface_distance(coarse, ball.model, 0.3).max();
  EXPECT_NEAR(rough, fine, 0.15 * fine);
  EXPECT_GE(fine, rough * (1 - 1e-3));
}

TEST(SurfaceDistance, TheCoarsestLatticeHasTheCentroid) {
  const auto cube = modelled_cube(1);
  TetMesh dented = build(test::kuhn_cube(6)).mesh;
  const Corners facet = cube.model.facet_corners(0);
  const Vec3 centroid = (facet[0] + facet[1] + facet[2]) / 3;
  const Vec3 inwards = normalized(Vec3{0.5, 0.5, 0.5} - centroid);
  int moved = 0;
  for (Vec3& p : dented.points)
    if (distance(p, centroid) < 1e-9) p += 0.1 * inwards, ++moved;
  ASSERT_EQ(moved, 1);
  const SurfaceDistance d = measure_surface_distance(dented, cube.model, 10);
  EXPECT_GT(d.model_to_out.max, 0.05);
  // In the dent, whose sides are nearer to the centroid than to a place beside it.
  EXPECT_LT(distance(d.model_to_out.where, centroid), 1.0 / 12);
}

TEST(SurfaceDistance, SamplesMoreOnlyWhereItIsNotNear) {
  const auto ball = modelled_ball(6);
  const TetMesh other = modelled_ball(9).mesh;
  const SurfaceDistance all = measure_surface_distance(other, ball.model, kStep);
  const double half = all.worse().worst / 2;
  const double none = std::numeric_limits<double>::infinity();
  const SurfaceDistance some = measure_surface_distance(other, ball.model, kStep, none, half);
  EXPECT_EQ(some.max(), all.max());
  const SurfaceDistance few = measure_surface_distance(other, ball.model, kStep, none, none);
  EXPECT_LE(few.max(), all.max());
  EXPECT_GE(few.max(), 0.8 * all.max());
}

TEST(SurfaceDistance, BoundsLeaveOutOnlyWhatIsNearer) {
  const auto ball = modelled_ball(14);
  const TetMesh other = modelled_ball(17).mesh;  // more triangles than are made exact at once
  const SurfaceDistance all = measure_surface_distance(other, ball.model, kStep);
  const double none = std::numeric_limits<double>::infinity();
  for (const double share : {0.05, 0.3, 0.6}) {
    SCOPED_TRACE(share);
    const double enough = share * all.worse().worst;
    const SurfaceDistance some = measure_surface_distance(other, ball.model, kStep, none, enough);
    EXPECT_EQ(some.out_to_model.max, all.out_to_model.max);
    EXPECT_EQ(some.model_to_out.max, all.model_to_out.max);
  }
}

void expect_same(const OneSidedDistance& a, const OneSidedDistance& b) {
  EXPECT_DOUBLE_EQ(a.max, b.max);
  EXPECT_DOUBLE_EQ(a.mean, b.mean);
  EXPECT_DOUBLE_EQ(a.worst, b.worst);
  EXPECT_EQ(a.hausd, b.hausd);
}

void expect_same(const std::vector<FarSample>& a, const std::vector<FarSample>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].id, b[i].id);
    EXPECT_DOUBLE_EQ(a[i].distance, b[i].distance);
  }
}

void expect_as_alone(const DistanceSampling& sampling) {
  const auto ball = modelled_ball(6);
  constexpr unsigned kSeed = 11;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> pull(0.9, 1.05);
  TetMesh mesh = modelled_ball(9).mesh;
  DistanceMeter meter(ball.model, sampling);
  for (int step = 0; step < 12; ++step) {
    for (int k = 0; k < 3; ++k) mesh.points[random() % mesh.points.size()] *= pull(random);
    if (step % 3 == 2) mesh.triangles.erase(mesh.triangles.begin() + random() % 20);
    if (step == 6) std::ranges::shuffle(mesh.triangles, random);
    const SurfaceDistance now = meter.measure(mesh);
    const SurfaceDistance alone = measure_surface_distance(mesh, ball.model, sampling.step.out,
                                                           sampling.most, sampling.enough);
    expect_same(now.out_to_model, alone.out_to_model);
    expect_same(now.model_to_out, alone.model_to_out);
    expect_same(now.far_triangles, alone.far_triangles);
    expect_same(now.far_facets, alone.far_facets);
  }
  mesh.triangles.clear();
  EXPECT_EQ(meter.measure(mesh).model_to_out.max, std::numeric_limits<double>::infinity());
}

TEST(DistanceMeter, SaysOfEachMeshWhatIsSaidOfItAlone) {
  for (const double enough : {0.0, 0.2}) {
    SCOPED_TRACE(enough);
    expect_as_alone({{kStep, kStep}, 0.5, enough});
  }
}

std::vector<std::uint64_t> bits(const SurfaceDistance& d) {
  std::vector<std::uint64_t> all;
  const auto add = [&](double x) { all.push_back(std::bit_cast<std::uint64_t>(x)); };
  const auto add_place = [&](const Vec3& p) { add(p.x), add(p.y), add(p.z); };
  for (const OneSidedDistance& side : {d.out_to_model, d.model_to_out})
    add(side.max), add(side.mean), add_place(side.where);
  for (const auto& list : {d.far_triangles, d.far_facets})
    for (const FarSample& s : list) add(s.id), add(s.distance), add_place(s.where);
  return all;
}

TEST(SurfaceDistance, HasTheSameBitsAtAnyNumberOfThreads) {
  const auto ball = modelled_ball(8);
  const TetMesh other = modelled_ball(12).mesh;
  std::vector<std::uint64_t> first;
  for (const int threads : {1, 2, 3, 8})
    run_in_arena(threads, [&] {
      auto now = bits(measure_surface_distance(other, ball.model, kStep, 4));
      now.push_back(std::bit_cast<std::uint64_t>(measure_bulge(ball.model)));
      if (threads == 1) first = now;
      EXPECT_EQ(now, first) << threads << " threads";
    });
  EXPECT_GT(first.size(), 20u);
}

TEST(DefaultSampleSteps, FollowTheBoxAndTheMesh) {
  const auto fine = modelled_ball(12);
  const auto coarse = modelled_ball(2);
  const SampleSteps steps = default_sample_steps(fine.mesh, fine.model);
  EXPECT_GE(steps.out, 2 * std::sqrt(3.0) / 400 * 0.99);
  EXPECT_GE(steps.model, steps.out);
  EXPECT_GT(default_sample_steps(coarse.mesh, fine.model).out, steps.out);
  EXPECT_GT(default_sample_steps(coarse.mesh, fine.model).model, steps.model);
  EXPECT_NEAR(default_sample_steps(fine.mesh, coarse.model).model, steps.model, 0.1 * steps.model);
  const SampleSteps any = default_sample_steps(TetMesh{}, test::modelled(TetMesh{}).model);
  EXPECT_GT(any.out, 0);
  EXPECT_GT(any.model, 0);
}

/// Of a facet that is a thousand times larger than the mesh's triangles.
TEST(DefaultSampleSteps, ADentOfOneVertexIsFoundFromALargeFacet) {
  const auto cube = modelled_cube(1);
  const TetMesh flat = build(test::kuhn_cube(24)).mesh;
  const double depth = 1.2 * cube.model.hausd(0);
  constexpr unsigned kSeed = 5;
  SCOPED_TRACE(kSeed);
  std::mt19937 random(kSeed);
  for (int trial = 0; trial < 20; ++trial) {
    TetMesh dented = flat;
    const double x = double(1 + random() % 23) / 24, y = double(1 + random() % 23) / 24;
    int moved = 0;
    for (Vec3& p : dented.points)
      if (distance(p, {x, y, 1}) < 1e-9) p.z -= depth, ++moved;
    ASSERT_EQ(moved, 1);
    DistanceMeter meter(cube.model, {default_sample_steps(dented, cube.model), 0.95, 0.5});
    const SurfaceDistance d = meter.measure(dented);
    EXPECT_GT(d.model_to_out.max, 0.96 * depth) << x << " " << y;
    EXPECT_FALSE(d.far_facets.empty());
  }
}

}  // namespace
}  // namespace cavea
