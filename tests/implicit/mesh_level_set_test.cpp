// From functions to meshes: the box, its refinement, the cut, and the way back onto the function.
#include "cavea/implicit/mesh_level_set.h"

#include <set>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/implicit/box_mesh.h"
#include "cavea/implicit/clear.h"
#include "cavea/implicit/facet.h"
#include "cavea/implicit/project.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/statistics.h"
#include "cavea/remesh/remesh.h"
#include "level_sets.h"
#include "support/expect.h"

namespace cavea::test {
namespace {

constexpr Box kUnit{{0, 0, 0}, {1, 1, 1}};

LevelSet with_slope(const Function& f) { return with_gradient({f, {}}, std::numbers::sqrt3); }

/// Share of the unit box in which the function is negative: midpoints of n^3 cells.
double quadrature(const Function& f, int n) {
  std::int64_t inside = 0;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) inside += f({(i + 0.5) / n, (j + 0.5) / n, (k + 0.5) / n}) < 0;
  return double(inside) / std::pow(n, 3);
}

TEST(BoxMesh, FillsABoxWithKuhnTets) {
  const TetMesh cube = build(box_mesh(kUnit)).mesh;
  expect_sound(cube);
  EXPECT_EQ(cube.tets.size(), 6u * 512u);
  EXPECT_NEAR(quality_statistics(cube).worst, 0.657, 0.001);
  const Box slab{{-1, 2, 5}, {3, 2.5, 5.2}};
  const TetMesh mesh = build(box_mesh(slab, 100)).mesh;
  expect_sound(mesh);
  EXPECT_NEAR(volume(mesh), 4 * 0.5 * 0.2, 1e-12);
  EXPECT_EQ(to_data(cube).ridges.size(), 12u * 8u);
  EXPECT_EQ(count(mesh).box_min, slab.low);
  EXPECT_EQ(count(mesh).box_max, slab.high);
  EXPECT_GT(quality_statistics(mesh).worst, 0.5);
}

TEST(BoxMesh, RefusesWhatIsNoBox) {
  EXPECT_THROW(box_mesh({{0, 0, 0}, {1, 0, 1}}), OptionError);
  EXPECT_THROW(box_mesh({{0, 0, 0}, {1, NAN, 1}}), OptionError);
  EXPECT_THROW(box_mesh(Box{}), OptionError);
  EXPECT_THROW(box_mesh(kUnit, 0), OptionError);
}

TEST(ZeroOnEdge, IsFoundInAnyFunctionThatChangesItsSign) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0};
  const auto expect_zero = [&](const Function& f, double zero) {
    EXPECT_NEAR(zero_on_edge({f, {}}, a, b, f(a), f(b)), zero, 1e-11);
  };
  expect_zero([](const Vec3& p) { return p.x - 0.3; }, 0.3);
  expect_zero([](const Vec3& p) { return std::pow(p.x, 20) - 1e-3; }, std::pow(1e-3, 0.05));
  expect_zero([](const Vec3& p) { return p.x < 0.123 ? -1.0 : 1e-9; }, 0.123);
  expect_zero([](const Vec3& p) { return 0.7 - p.x; }, 0.7);
  expect_zero([](const Vec3& p) { return std::clamp(100 * (p.x - 0.02), -1.0, 0.1); }, 0.02);
}

TetMesh refined(const Function& f, double tolerance, double shortest) {
  TetMesh mesh = build(box_mesh(kUnit)).mesh;
  const LevelSet level_set = with_slope(f);
  refine_near(mesh, level_set, zeros_on_lattice(level_set, kUnit, 1.0 / 64), {tolerance, shortest});
  return mesh;
}

TEST(Refinement, KeepsToThreeShapesAndToWhereItIsNeeded) {
  const TetMesh mesh = refined(sphere, 0.001, 1e-3);
  expect_sound(mesh);
  std::set<long> shapes;
  for (const float q : mesh.qualities) shapes.insert(std::lround(q * 1e4));
  EXPECT_EQ(shapes.size(), 3u);
  double nearest = 1, farthest = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    const double size = std::cbrt(volume6(a, b, c, d));
    (std::abs(sphere(a)) < 0.01 ? nearest : farthest) =
        std::abs(sphere(a)) < 0.01 ? std::min(nearest, size) : std::max(farthest, size);
  }
  EXPECT_NEAR(nearest, std::sqrt(8 * 0.001 * 0.3), 0.03);  // the chord of that sagitta
  EXPECT_NEAR(farthest, 0.125, 1e-12);
  EXPECT_LT(mesh.tets.size(), 40000u);
}

TEST(Refinement, EndsAtTheShortestEdge) {
  const auto cube = [](const Vec3& p) {
    return std::max({std::abs(p.x - 0.5), std::abs(p.y - 0.5), std::abs(p.z - 0.5)}) - 0.3;
  };
  const TetMesh mesh = refined(cube, 1e-6, 0.05);
  expect_sound(mesh);
  double shortest = 1;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto corners = mesh.corners(TetId(t));
    double longest = 0;
    for (const auto& e : kEdgeVertices)
      longest = std::max(longest, distance(corners[e[0]], corners[e[1]]));
    shortest = std::min(shortest, longest);
  }
  EXPECT_LE(shortest, 0.05);
  // What is in the way of another may be halved once more.
  EXPECT_GT(shortest, 0.05 / 4);
}

TEST(Refinement, FindsWhatIsSmallerThanTheFirstTets) {
  const auto grain = [](const Vec3& p) { return norm(p - Vec3{0.31, 0.62, 0.45}) - 0.03; };
  const CutResult cut = mesh_level_set(kUnit, {grain, {}}, {}, {0.0005, 1e-3});
  expect_sound(cut.mesh);
  const double exact = 4 * std::numbers::pi / 3 * std::pow(0.03, 3);
  EXPECT_NEAR(count(cut.mesh).volume_of_ref.at(3), exact, 0.1 * exact);
}

TEST(Refinement, FindsBothSidesOfAThinSheet) {
  const auto sheet = [](const Vec3& p) { return std::abs(p.z + 0.1 * p.x - 0.5) - 0.01; };
  const CutResult cut = mesh_level_set(kUnit, {sheet, {}}, {}, {0.0025, 1e-3});
  expect_sound(cut.mesh);
  expect_closed_manifold(cut.mesh);
  EXPECT_NEAR(count(cut.mesh).volume_of_ref.at(3), 0.02, 0.0002);
  EXPECT_TRUE(cut.report.open);
}

TEST(Refinement, SeesNormalsThatBendTheSmoothSurface) {
  const std::array<Vec3, 4> corners = {
      Vec3{0, 0, -0.5}, {1, 0, -0.5}, {0, 1, -0.5}, {0.3, 0.3, 0.5}};
  const std::array<double, 4> values = {-0.5, -0.5, -0.5, 0.5};
  const auto plane = [](const Vec3& p) { return p.z; };
  // Beyond x = 0.5 there is a crease, and the normal at it leans to the other face.
  const auto is_off = [&](double lean) {
    const LevelSet level_set{
        plane, [=](const Vec3& p) {
          return p.x > 0.5 ? Vec3{std::sin(lean), 0, std::cos(lean)} : Vec3{0, 0, 1};
        }};
    return is_cut_off_by(0.01, level_set, corners, values);
  };
  EXPECT_FALSE(is_off(0));
  EXPECT_FALSE(is_off(0.05)) << "an eighth of the edge of 0.5 times it is less than the tolerance";
  EXPECT_TRUE(is_off(0.3));
}

TEST(Refinement, SparesWhatIsRequired) {
  MeshData data = box_mesh(kUnit, 64);
  data.required_tets = {5, 200};
  TetMesh mesh = build(data).mesh;
  const auto corners_of_required = [](const TetMesh& m) {
    std::set<std::array<double, 3>> places;
    for (std::size_t t = 0; t < m.tets.size(); ++t)
      if (m.tet_flags[t] & tet_flag::kRequired)
        for (const Vec3& p : m.corners(TetId(t))) places.insert({p.x, p.y, p.z});
    return places;
  };
  const auto before = corners_of_required(mesh);
  const LevelSet level_set = with_slope(sphere);
  refine_near(mesh, level_set, {}, {0.002, 1e-3});
  expect_sound(mesh);
  EXPECT_GT(mesh.tets.size(), 2000u);
  EXPECT_EQ(corners_of_required(mesh), before);
}

TEST(Clearing, LeavesNoSlivers) {
  TetMesh mesh = refined(sphere, 0.001, 1e-3);
  const double before = quality_statistics(cut_along(mesh, sphere).mesh).worst;
  clear_for_cut(mesh, with_slope(sphere), 0.002);
  expect_sound(mesh);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
  EXPECT_GT(quality_statistics(mesh).worst, 0.15);
  const double after = quality_statistics(cut_along(mesh, sphere).mesh).worst;
  EXPECT_LT(before, 0.01);
  EXPECT_GT(after, 0.02);
}

TEST(LevelSets, OfRandomWavesAreConformingClosedAndOfTheirVolume) {
  constexpr int kSeeds = kSanitized ? 20 : 200;
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::uint64_t(seed) + 1000};
    const Waves waves(random);
    const double exact = quadrature(waves, 28);
    if (exact < 0.01 || exact > 0.99) continue;
    constexpr double kTolerance = 0.05, kCell = 1.0 / 14;  // a sixth of the shortest wave
    const LevelSet level_set = waves.level_set();
    const CutResult cut = mesh_level_set(
        kUnit, level_set, zeros_on_lattice(level_set, kUnit, kCell), {kTolerance, 0.17});
    expect_sound(cut.mesh);
    expect_closed_manifold(cut.mesh);
    const auto volumes = count(cut.mesh).volume_of_ref;
    EXPECT_NEAR(volumes.at(2) + volumes.at(3), 1, 1e-12);
    EXPECT_NEAR(volumes.at(3), exact, 0.015);
    EXPECT_GT(quality_statistics(cut.mesh).worst, kFlat);
  }
}

/// Cuts the unit box, remeshes it and puts the interface onto the function.
TetMesh remeshed(const LevelSet& level_set, double hausd, int threads,
                 CutReport* report = nullptr) {
  CutResult cut;
  run_in_arena(threads, [&] { cut = mesh_level_set(kUnit, level_set, {}, {hausd / 2, hausd}); });
  Options options;
  options.hausd = hausd;
  options.max_bulge = std::max(3 * hausd, cut.report.needed_bulge());
  options.threads = threads;
  options.finish = [&](TetMesh& mesh) { project_onto(mesh, level_set, 10); };
  remesh(cut.mesh, {}, options);
  if (report) *report = cut.report;
  return std::move(cut.mesh);
}

TEST(LevelSets, OfRandomWavesStayThemselvesWhenRemeshed) {
  for (int seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::uint64_t(seed) + 2000};
    const Waves waves(random);
    constexpr double kHausd = 0.02;
    const TetMesh mesh = remeshed(waves.level_set(), kHausd, 2);
    expect_sound(mesh);
    expect_closed_manifold(mesh);
    EXPECT_GT(quality_statistics(mesh).worst, 0.03);  // where waves meet the box at small angles
    EXPECT_LT(distance_from(mesh, waves.level_set(), 10), 2 * kHausd);
    EXPECT_NEAR(count(mesh).volume_of_ref.at(3), quadrature(waves, 48), 0.01);
  }
}

TEST(LevelSets, AreTheSameAtAnyNumberOfThreads) {
  const auto blob = [](const Vec3& p) { return sphere(p) + 0.03 * std::sin(20 * p.x) * p.y; };
  const TetMesh one = remeshed(with_slope(blob), 0.01, 1);
  for (const int threads : {2, 3}) expect_same(one, remeshed(with_slope(blob), 0.01, threads));
}

TEST(Projection, PutsVerticesOntoTheFunction) {
  CutReport report;
  const TetMesh mesh = remeshed(with_slope(sphere), 0.002, 2, &report);
  EXPECT_LT(report.needed_bulge(), 3 * 0.002) << "no other bulge is needed than the usual one";
  for (const Triangle& s : mesh.triangles)
    for (const VertexId v : s.v)
      if (s.ref == 10) {
        EXPECT_NEAR(sphere(mesh.points[v]), 0, 1e-9);
      }
  const LevelSet level_set = with_slope(sphere);
  EXPECT_LT(distance_from(mesh, level_set, 10), 0.002);
  const double exact = 4 * std::numbers::pi / 3 * 0.027;
  // Vertices on a sphere always lose: 3 / 0.3 of half the sagitta, about.
  EXPECT_NEAR(count(mesh).volume_of_ref.at(3), exact, 0.01 * exact);
  EXPECT_LT(count(mesh).volume_of_ref.at(3), exact);
}

TEST(Projection, MeasuresDistancesUpToATrianglesLongestEdge) {
  const TetMesh mesh = cut_along(build(box_mesh(kUnit)).mesh, sphere).mesh;
  double shortest = 1;
  for (const Triangle& s : mesh.triangles) {
    double longest = 0;
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, distance(mesh.points[s.v[k]], mesh.points[s.v[(k + 1) % 3]]));
    if (s.ref == 10) shortest = std::min(shortest, longest);
  }
  const double away = 0.8 * shortest;
  const auto larger = [=](const Vec3& p) { return sphere(p) - away; };
  const double sagitta = distance_from(mesh, with_slope(sphere), 10);
  EXPECT_LT(sagitta, 0.02);
  EXPECT_NEAR(distance_from(mesh, with_slope(larger), 10), away + sagitta, 1e-6);
}

TEST(Projection, KeepsCurvesOnTheBoundary) {
  const auto wall = [](const Vec3& p) { return p.x - 0.5 + 0.1 * std::sin(5 * p.y + 2 * p.z); };
  const TetMesh mesh = remeshed(with_slope(wall), 0.004, 2);
  expect_sound(mesh);
  expect_closed_manifold(mesh);
  EXPECT_NEAR(volume(mesh), 1, 1e-12);
  double worst = 0;
  for (const Triangle& s : mesh.triangles)
    for (const VertexId v : s.v)
      if (s.ref == 10) worst = std::max(worst, std::abs(wall(mesh.points[v])));
  EXPECT_LT(worst, 1e-6);
}

}  // namespace
}  // namespace cavea::test
