// One run: its options, its report, its end.
#include <algorithm>
#include <limits>
#include <set>
#include <stdexcept>

#include "cavea/base/error.h"
#include "remesh/refused.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(Options, AreRefusedWhenSenseless) {
  for (const double bad : {0.0, -1.0, kNan, kInfinity}) {
    expect_refused([&](Options& o) { o.hausd = bad; }, "hausd");
    expect_refused([&](Options& o) { o.hmin = bad; }, "hmin");
    expect_refused([&](Options& o) { o.hmax = bad; }, "hmax");
    expect_refused([&](Options& o) { o.hsiz = bad; }, "hsiz");
  }
  for (const double bad : {0.99, 0.0, -2.0, kNan, kInfinity})
    expect_refused([&](Options& o) { o.hgrad = bad; }, "hgrad");
  for (const double bad : {0.99, -1.0, kNan, kInfinity})
    expect_refused([&](Options& o) { o.hgradreq = bad; }, "hgradreq");
  for (const double bad : {-1.0, 181.0, kNan})
    expect_refused([&](Options& o) { o.angle = bad; }, "angle");
  for (const double bad : {-0.1, 1.1, kNan})
    expect_refused([&](Options& o) { o.min_quality = bad; }, "min_quality");
  for (const double bad : {-1.0, 101.0, kNan})
    expect_refused([&](Options& o) { o.min_conform = bad; }, "min_conform");
  expect_refused([](Options& o) { o.hmin = 2, o.hmax = 1; }, "hmin");
  expect_refused([](Options& o) { o.hsiz = 1, o.hmin = 0.5; }, "hsiz");
  expect_refused([](Options& o) { o.hsiz = 1, o.hmax = 2; }, "hsiz");
  expect_refused([](Options& o) { o.hsiz = 1, o.optim = true; }, "optim");
  expect_refused([](Options& o) { o.max_tets = 0; }, "max_tets");
  expect_refused([](Options& o) { o.threads = -1; }, "threads");
}

TEST(Options, OfNoHarmAreTaken) {
  EXPECT_NO_THROW(validate({}));
  Options options;
  options.hmin = options.hmax = 0.5;
  options.hgrad = 1;
  options.hgradreq.reset();
  options.angle = 180;
  options.threads = 64;
  EXPECT_NO_THROW(validate(options));
}

TEST(Remesh, WithSenselessOptionsLeavesTheMesh) {
  const TetMesh start = built(kuhn_cube(2));
  TetMesh mesh = start;
  EXPECT_THROW(remesh(mesh, {}, uniform(-1)), OptionError);
  expect_same(mesh, start);
}

TEST(Remesh, OfAThinPlateOfNeedlesGoesOnFromItsSurface) {
  MeshData plate = kuhn_cube(1);
  for (Vec3& p : plate.vertices) p.z *= 0.03;
  TetMesh mesh = built(plate);
  const Report report = remesh(mesh, {}, uniform(0.045));
  EXPECT_EQ(times_of("surface", report), 1);
  EXPECT_EQ(times_of("bulk", report) + times_of("rough", report), 0);
  expect_sound(mesh);
  EXPECT_GE(report.after.quality.worst, 0.3);
  EXPECT_GE(report.after.quality.mean, 0.78);
  EXPECT_GE(report.after.lengths.conforming_percent(), 95);
}

/// Cancels runs from `start` in each of their phases; \return their result.
TetMesh cancel_in_each_phase(const TetMesh& start, Options options) {
  std::set<std::string> phases;
  TetMesh finished = start;
  options.progress = [&](const Progress& p) { phases.insert(p.phase); };
  remesh(finished, {}, options);
  EXPECT_GE(phases.size(), 4u);
  for (const std::string& phase : phases) {
    SCOPED_TRACE(phase);
    TetMesh mesh = start;
    std::atomic<bool> cancel = false;
    options.cancel = &cancel;
    options.progress = [&](const Progress& p) { cancel = cancel || p.phase == phase; };
    if (phase == "statistics") continue;  // nothing is asked after it
    EXPECT_THROW(remesh(mesh, {}, options), Cancelled);
    expect_same(mesh, start);
  }
  return finished;
}

TEST(Remesh, CancelledLeavesTheMesh) {
  const TetMesh result = cancel_in_each_phase(built(kuhn_cube(4)), uniform(0.1));
  SCOPED_TRACE("that stands");
  const TetMesh again = cancel_in_each_phase(built(to_data(result)), uniform(0.1));
  EXPECT_TRUE(again.points == result.points);
}

TEST(Remesh, WhoseProgressThrowsLeavesTheMesh) {
  const TetMesh start = built(kuhn_cube(3));
  TetMesh mesh = start;
  Options options = uniform(0.1);
  options.progress = [](const Progress& p) {
    if (std::string(p.phase) == "fine") throw std::length_error("enough");
  };
  EXPECT_THROW(remesh(mesh, {}, options), std::length_error);
  expect_same(mesh, start);
}

TEST(Remesh, TellsHowManyTetsThereWillBe) {
  TetMesh mesh = built(kuhn_cube(2));
  Options options = uniform(0.05);
  Progress last;
  std::int64_t of_seeding = 0;
  options.progress = [&](const Progress& p) {
    last = p;
    if (std::string(p.phase) == "seeding") of_seeding = p.wanted;
  };
  remesh(mesh, {}, options);
  const auto tets = double(mesh.tets.size());
  EXPECT_NEAR(double(last.wanted), tets, 0.3 * tets);
  EXPECT_EQ(of_seeding, last.wanted);
}

TEST(Remesh, ReportsWhatItDid) {
  TetMesh mesh = built(kuhn_cube(4));
  const Report report = remesh(mesh, {}, uniform(0.1, 2));
  EXPECT_EQ(report.threads, 2);
  EXPECT_EQ(report.before.counts.tets, 6 * 4 * 4 * 4);
  EXPECT_EQ(report.after.counts.tets, std::int64_t(mesh.tets.size()));
  EXPECT_EQ(report.part_of_tet.size(), mesh.tets.size());
  EXPECT_EQ(report.hmin, 0.1);
  EXPECT_EQ(report.hmax, 0.1);
  EXPECT_GT(report.seconds, 0);
  EXPECT_GT(report.peak_resident_bytes, 0);
  double seconds = 0;
  for (const PhaseTime& phase : report.phases) seconds += phase.seconds;
  EXPECT_LE(seconds, report.seconds);
  std::int64_t accepted = 0;
  for (const VerdictCount& v : report.verdicts) {
    EXPECT_GT(v.count, 0);
    if (v.verdict == "accept") accepted += v.count;
  }
  EXPECT_GT(accepted, 0);
  EXPECT_EQ(report.targets.size(), 5u);
  EXPECT_TRUE(report.targets_met());
}

TEST(Remesh, TellsNormalsAndTangentsOnDemand) {
  for (const bool asked : {false, true}) {
    TetMesh mesh = built(kuhn_cube(2));
    Options options = uniform(0.3);
    options.directions = asked;
    const Report report = remesh(mesh, {}, options);
    EXPECT_EQ(report.directions.normals.empty(), !asked);
    EXPECT_EQ(report.directions.tangents.empty(), !asked);
    MeshData data = to_data(mesh);
    add_directions(SurfaceDirections(report.directions), data);
    // On the cube's faces and edges; they are planes and straight, up to rounding.
    const auto on_side = [](double x) { return std::abs(2 * x - 1) > 1 - 1e-9; };
    for (const auto& [v, n] : data.normal_at_vertices) {
      const Vec3 &p = data.vertices[v], &normal = data.normals[n];
      EXPECT_EQ(on_side(p.x) + on_side(p.y) + on_side(p.z), 1);
      EXPECT_NEAR(dot(normal, 2 * p - Vec3{1, 1, 1}), 1, 1e-12);
    }
    for (const auto& [v, t] : data.tangent_at_vertices) {
      const Vec3& p = data.vertices[v];
      EXPECT_EQ(on_side(p.x) + on_side(p.y) + on_side(p.z), 2);
    }
  }
}

TEST(Remesh, SaysWhichTargetItMissed) {
  TetMesh mesh = built(kuhn_cube(2));
  Options options = uniform(0.3);
  options.min_quality = 1;
  const Report report = remesh(mesh, {}, options);
  EXPECT_FALSE(report.targets_met());
  for (const Target& t : report.targets) {
    EXPECT_EQ(t.met, t.name != "worst quality") << t.name;
    EXPECT_EQ(t.met, t.where.empty());
  }
}

/// Share of the vertices of `now` that stand where one of `before` stood.
double share_left_alone(const TetMesh& before, const TetMesh& now) {
  const auto less = [](const Vec3& a, const Vec3& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
  };
  std::set<Vec3, decltype(less)> places(less);
  places.insert(before.points.begin(), before.points.end());
  std::size_t same = 0;
  for (const Vec3& p : now.points) same += places.count(p);
  return double(same) / double(now.points.size());
}

TEST(Remesh, OfItsOwnResultChangesLittle) {
  TetMesh once = built(kuhn_cube(4));
  remesh(once, {}, uniform(0.07));
  TetMesh twice = once;
  const Report report = remesh(twice, {}, uniform(0.07));
  expect_sound(twice);
  expect_good(report);
  EXPECT_GT(share_left_alone(once, twice), 0.9);
  EXPECT_NEAR(double(twice.tets.size()), double(once.tets.size()), 0.02 * double(once.tets.size()));
}

TEST(Remesh, TakesMeshesWithHoles) {
  TetMesh mesh = built(kuhn_cube(3));
  const Shape shape(mesh);
  TetMesh twin = mesh;
  // A dead vertex and a dead tet in the arrays, as operators leave them.
  mesh.resize_vertices(mesh.points.size() + 1);
  mesh.resize_tets(mesh.tets.size() + 1);
  remesh(mesh, {}, uniform(0.2));
  remesh(twin, {}, uniform(0.2));
  expect_sound(mesh);
  expect_same(mesh, twin);
}

TEST(Remesh, TakesASingleTet) {
  TetMesh mesh = built(single_tet());
  const Report report = remesh(mesh, {}, uniform(0.3));
  expect_sound(mesh);
  EXPECT_NEAR(report.after.counts.volume, 1.0 / 3, 1e-12);
  EXPECT_GE(report.after.quality.worst, 0.1);
  EXPECT_GT(report.after.counts.tets, 50);
}

TEST(Remesh, RepairsFlatTets) {
  for (const double off_flat : {0.0, 1e-12, 1e-3}) {
    SCOPED_TRACE(testing::Message() << off_flat << " from flat");
    MeshData data = kuhn_cube(2);
    // In the planes of four faces of the ball of the vertex in the middle.
    const double place = 0.125 + off_flat;
    *std::find(data.vertices.begin(), data.vertices.end(), Vec3{0.5, 0.5, 0.5}) = {place, place,
                                                                                   0.625};
    const BuildResult start = build(data);
    ASSERT_EQ(start.summary.flat_tets, off_flat > 0 ? 0 : 4);
    TetMesh mesh = start.mesh;
    expect_good(remesh(mesh, {}, uniform(0.2)));
    expect_sound(mesh);
  }
}

}  // namespace
}  // namespace cavea::test
