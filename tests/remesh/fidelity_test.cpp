// How near the result's surface is to the input's triangles, and to the shape that they stand for.
#include <algorithm>
#include <array>
#include <functional>
#include <iostream>
#include <map>

#include "cavea/base/error.h"
#include "cavea/surface/crossings.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

/// Largest distance of the surface's edge midpoints and centroids from a shape.
double farthest(const TetMesh& mesh, const std::function<double(const Vec3&)>& distance) {
  double worst = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.points[t.v[0]], b = mesh.points[t.v[1]], c = mesh.points[t.v[2]];
    for (const Vec3& x : {(a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3})
      worst = std::max(worst, std::abs(distance(x)));
  }
  return worst;
}

double to_sphere(const Vec3& p) { return norm(p) - 1; }

double to_cylinder(const Vec3& p) {
  const double side = std::hypot(p.x, p.y) - 1;
  return std::min({std::abs(side), std::abs(p.z), std::abs(p.z - 2)});
}

/// The torus of radii 3 and 1 around the z axis.
double to_torus(const Vec3& p) { return std::hypot(std::hypot(p.x, p.y) - 3, p.z) - 1; }

/// Vertices at one place become one.
MeshData merged(MeshData data) {
  std::map<std::array<std::int64_t, 3>, std::int32_t> first;
  std::vector<std::int32_t> id(data.vertices.size());
  for (std::size_t v = 0; v < id.size(); ++v) {
    const Vec3 p = 1e9 * data.vertices[v];
    const std::array<std::int64_t, 3> key{std::llround(p.x), std::llround(p.y), std::llround(p.z)};
    id[v] = first.emplace(key, std::int32_t(v)).first->second;
  }
  for (auto& t : data.tets)
    for (auto& v : t) v = id[std::size_t(v)];
  return data;
}

/// A square rod of n slices, rounded and bent into a ring.
MeshData torus(int n) {
  constexpr int kAcross = 4;
  MeshData data = kuhn_grid(n, [&](int, int j, int k) { return j < kAcross && k < kAcross; });
  const double width = double(kAcross) / n;
  for (Vec3& p : data.vertices) {
    const double x = 2 * p.y / width - 1, y = 2 * p.z / width - 1;
    const double r = 3 + x * std::sqrt(1 - y * y / 2), z = y * std::sqrt(1 - x * x / 2);
    const double angle = 2 * std::numbers::pi * p.x;
    p = {r * std::cos(angle), r * std::sin(angle), z};
  }
  return merged(std::move(data));
}

/// Prints the figures that docs/paper.md shows.
void expect_closer(const char* name, const MeshData& coarse,
                   const std::function<double(const Vec3&)>& distance) {
  TetMesh mesh = built(coarse);
  const double before = farthest(mesh, distance);
  Options options;
  options.hausd = before / 10;
  options.max_bulge = 2 * before;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  for (const Target& t : report.targets) EXPECT_TRUE(t.met) << t.name << " " << t.measured;
  const double after = farthest(mesh, distance);
  std::cout << name << ": " << before << " from the shape before, " << after << " after\n";
  EXPECT_LT(after, before / 2);
}

TEST(Fidelity, SmoothModelIsCloserToTheShapeThanItsTriangles) {
  expect_closer("sphere", ball(6), to_sphere);
  expect_closer("cylinder", cylinder(6), to_cylinder);
  expect_closer("torus", torus(24), to_torus);
}

// A pyramid upside down, over the diagonal of whose flat top a sliver stands upright.
TEST(Fidelity, SliversLowerThanTheToleranceForceNoPoorTets) {
  MeshData data;
  data.vertices = {{0, 0, 0},     {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.499, 0.501, 0.008},
                   {0.5, 0.5, -1}};
  data.tets = {{0, 1, 2, 5}, {0, 2, 4, 5}, {0, 4, 3, 5}, {4, 2, 3, 5}};
  data.vertex_refs.assign(6, 0), data.tet_refs.assign(4, 1);
  TetMesh mesh = built(data);
  Options options;
  options.hausd = 0.01;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_GT(report.after.quality.worst, 0.3);
  EXPECT_LE(report.surface_distance, report.hausd);
}

TEST(Fidelity, FacetedResultsStayOnTheTriangles) {
  for (const MeshData& coarse : {ball(4), cylinder(4), cylinder(9)}) {
    TetMesh mesh = built(coarse);
    Options options;
    options.faceted = true;
    const Report report = remesh(mesh, {}, options);
    expect_sound(mesh);
    EXPECT_TRUE(report.targets_met());
    EXPECT_LT(report.bulge, 1e-12);
    EXPECT_LE(report.surface_distance, report.hausd);
    EXPECT_GE(report.after.quality.worst, 0.2);
  }
}

TEST(Fidelity, LoopOnTheFirstSurfaceDoesNotDrift) {
  for (const MeshData& start : {ball(6), cylinder(6)}) {
    const TetMesh truth = built(start);
    TetMesh mesh = truth;
    double volume = 0;
    for (int step = 0; step < 6; ++step) {
      Options options;
      options.hausd = 0.02;
      options.hmax = step % 2 ? 0.5 : 0.3;
      options.surface = &truth;
      const Report report = remesh(mesh, {}, options);
      expect_sound(mesh);
      EXPECT_LE(report.surface_distance, report.hausd) << "step " << step;
      EXPECT_EQ(report.after.counts.boundary_components, 1);
      if (step == 0) volume = report.after.counts.volume;
      EXPECT_NEAR(report.after.counts.volume, volume, 0.01 * volume) << "step " << step;
    }
  }
}

Options on(const TetMesh& truth, double hausd, bool faceted) {
  Options options;
  options.hausd = hausd;
  options.faceted = faceted;
  options.surface = &truth;
  return options;
}

void expect_on_surface(const TetMesh& mesh, const Report& report) {
  expect_sound(mesh);
  EXPECT_LE(report.surface_distance, report.hausd);
  EXPECT_TRUE(find_crossings(mesh).empty());
}

TEST(Fidelity, AnotherBodysSurfaceIsRefused) {
  MeshData data = ball(6);
  const TetMesh truth = built(data);
  for (Vec3& p : data.vertices) p.x += 0.2;
  TetMesh mesh = built(data);
  EXPECT_THROW(remesh(mesh, {}, on(truth, 0.003, false)), cavea::InputError);
  for (Vec3& p : data.vertices) p.x -= 0.199;
  mesh = built(data);
  EXPECT_NO_THROW(remesh(mesh, {}, on(truth, 0.003, false)));
  expect_sound(mesh);
}

/// No place is nearer to a surface than rounding allows, however fine the mesh is there.
TEST(Fidelity, RepairsThatAreInVainEnd) {
  TetMesh mesh = built(mapped(kuhn_cube(1), [](const Vec3& p) {
    return Vec3{0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y, p.z};
  }));
  Options options;
  options.hausd = 1e-17;
  options.optim = true;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_GT(report.surface_distance, report.hausd);
  EXPECT_LT(report.after.counts.tets, 100'000);
}

// Curves of a coarse truth bulge by more than two tolerances from its edges.
TEST(Fidelity, ResultStandsOnItsOwnTruth) {
  const TetMesh truth = built(cylinder(2));
  TetMesh mesh = truth;
  remesh(mesh, {}, on(truth, 0.01, false));
  const TetMesh first = mesh;
  expect_on_surface(mesh, remesh(mesh, {}, on(truth, 0.01, false)));
  EXPECT_EQ(mesh.tets, first.tets);
}

// A smooth result has no edges along the creases of the facets, nor a coarse one along all of them;
// a result along facets has corners where the smooth curve goes on.
TEST(Fidelity, ResultMayBeGivenAnotherModelOfItsTruth) {
  const TetMesh truth = built(cylinder(2));
  for (const bool was_faceted : {false, true})
    for (const bool is_faceted : {false, true})
      for (const double was_within : {0.01, 0.05}) {
        TetMesh mesh = truth;
        const Report first = remesh(mesh, {}, on(truth, was_within, was_faceted));
        const Report second = remesh(mesh, {}, on(truth, 0.01, is_faceted));
        expect_on_surface(mesh, second);
        EXPECT_LT(second.after.counts.tets, 20 * first.after.counts.tets);
      }
}

TEST(Fidelity, BulgeStaysWithinItsBound) {
  for (const double most : {0.0, 0.01, 0.05}) {
    TetMesh mesh = built(ball(4));
    Options options;
    options.hausd = 0.01;
    options.max_bulge = most;
    const Report report = remesh(mesh, {}, options);
    expect_sound(mesh);
    EXPECT_LE(report.bulge, most + 1e-12);
    EXPECT_GE(report.bulge, most / 3);
  }
}

TEST(Fidelity, ACrossingOfTheInputIsTold) {
  // Two cubes that overlap without a vertex in common.
  MeshData data = kuhn_cube(3);
  const std::int32_t own = std::int32_t(data.vertices.size());
  for (std::int32_t v = 0; v < own; ++v)
    data.vertices.push_back(data.vertices[std::size_t(v)] + Vec3{0.81, 0.13, 0.27});
  for (std::size_t t = 0, n = data.tets.size(); t < n; ++t) {
    std::array<std::int32_t, 4> tet = data.tets[t];
    for (std::int32_t& v : tet) v += own;
    data.tets.push_back(tet);
  }
  data.vertex_refs.clear(), data.tet_refs.clear();
  TetMesh mesh = built(data);
  Options options;
  options.hausd = 0.05;
  const Report report = remesh(mesh, {}, options);
  EXPECT_FALSE(report.targets_met());
  ASSERT_EQ(report.warnings.size(), 1u);
  EXPECT_NE(report.warnings[0].find("passes through itself"), std::string::npos);

  TetMesh sound = built(kuhn_cube(3));
  EXPECT_TRUE(remesh(sound, {}, options).warnings.empty());
}

/// A prism on a regular polygon, cut into tets around its axis.
MeshData prism(int sides) {
  MeshData data;
  for (const double z : {0.0, 2.0}) {
    data.vertices.push_back({0, 0, z});
    for (int k = 0; k < sides; ++k) {
      const double a = 2 * std::numbers::pi * k / sides;
      data.vertices.push_back({std::cos(a), std::sin(a), z});
    }
  }
  for (std::int32_t k = 0; k < sides; ++k) {
    const std::int32_t a = 1 + k, b = 1 + (k + 1) % sides, up = sides + 1;
    data.tets.push_back({0, a, b, up});
    data.tets.push_back({a, b, up, a + up});
    data.tets.push_back({b, up, a + up, b + up});
  }
  data.vertex_refs.assign(data.vertices.size(), 0), data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

TEST(Fidelity, CoarseRoundShapesAreFollowed) {
  // Their smooth surfaces would bulge by many tolerances, and meet in creases if they may not.
  for (const MeshData& data : {prism(8), prism(12), prism(14), prism(16), ball(3)}) {
    TetMesh mesh = built(data);
    const Report report = remesh(mesh, {}, {});
    expect_sound(mesh);
    EXPECT_LE(report.surface_distance, report.hausd) << data.vertices.size() << " vertices";
    EXPECT_LE(report.bulge, 3 * report.hausd);
    EXPECT_LT(report.after.counts.tets, 60000);
  }
}

TEST(Fidelity, NearSheetsNeverCross) {
  // A ball with a slit: two sheets that are nearer to each other than the tolerance.
  for (const double gap : {0.02, 0.005, 0.001}) {
    MeshData data = kuhn_grid(7, [](int i, int, int k) { return k != 3 || i == 0; });
    for (Vec3& p : data.vertices) {
      const double layer = std::round(7 * p.z);
      p.z = layer <= 3 ? layer / 7 : 3.0 / 7 + gap + (layer - 4) / 7;
      p.z += 0.1 * std::sin(3 * p.x) * std::cos(2 * p.y);
    }
    TetMesh mesh = built(data);
    ASSERT_TRUE(find_crossings(mesh).empty());
    Options options;
    options.hausd = 0.02;
    options.hmin = 0.05;
    const Report report = remesh(mesh, {}, options);
    expect_sound(mesh);
    EXPECT_TRUE(find_crossings(mesh).empty()) << "gap " << gap;
    EXPECT_LE(report.surface_distance, report.hausd);
  }
}

/// A cube with a bump on its top, too narrow for the size.
TEST(Fidelity, UniformSizesGiveWayInPlaces) {
  const MeshData data = mapped(kuhn_cube(24), [](const Vec3& p) {
    const double r2 = (p.x - 0.5) * (p.x - 0.5) + (p.y - 0.5) * (p.y - 0.5);
    return Vec3{p.x, p.y, p.z * (1 + 0.08 * std::exp(-r2 / 0.005))};
  });
  TetMesh mesh = built(data);
  Options options = uniform(kSanitized ? 0.08 : 0.06);
  options.hausd = 0.003;
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_LE(report.surface_distance, report.hausd);
  EXPECT_GT(report.after.lengths.conforming_percent(), 95);
  const auto smaller =
      std::ranges::count_if(mesh.sizes, [&](float h) { return h < 0.999F * float(*options.hsiz); });
  EXPECT_GT(smaller, 0) << "nothing had to give way";
  EXPECT_LT(double(smaller), 0.2 * double(mesh.sizes.size()));
}

}  // namespace
}  // namespace cavea::test
