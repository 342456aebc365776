// Several level sets, of which the earlier ones count where they overlap.
#include <set>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/implicit/mesh_level_set.h"
#include "cavea/implicit/project.h"
#include "cavea/implicit/signs.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/statistics.h"
#include "cavea/remesh/remesh.h"
#include "level_sets.h"
#include "support/expect.h"

namespace cavea::test {
namespace {

constexpr Box kUnit{{0, 0, 0}, {1, 1, 1}};

Function ball(const Vec3& center, double radius) {
  return [=](const Vec3& p) { return distance(p, center) - radius; };
}

/// Of the surface of the three balls: volumes are off by no more than it times the tolerance.
constexpr double kArea = 1.2;

/// Each two of them meet in a circle, all three in two points.
std::vector<Function> three_balls() {
  return {ball({0.4, 0.42, 0.5}, 0.2), ball({0.62, 0.45, 0.5}, 0.22), ball({0.5, 0.62, 0.5}, 0.2)};
}

/// Zeros are looked for on a lattice of the default.
std::vector<StackedLevelSet> stack_of(const std::vector<Function>& functions,
                                      const RefineOptions& refine) {
  std::vector<StackedLevelSet> stack;
  for (const Function& f : functions)
    stack.push_back({with_gradient({f, {}}, std::numbers::sqrt3), {}, refine, {}});
  return stack;
}

/// The reference of tets at a point: 3 and up by the first function that is negative, else 2.
std::int32_t reference_at(const std::vector<Function>& functions, const Vec3& p) {
  for (std::size_t k = 0; k < functions.size(); ++k)
    if (functions[k](p) < 0) return 3 + std::int32_t(k);
  return 2;
}

/// Volumes by reference in the unit box: midpoints of n^3 cells.
std::map<std::int32_t, double> quadrature(const std::vector<Function>& functions, int n) {
  std::map<std::int32_t, double> volumes;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        volumes[reference_at(functions, {(i + 0.5) / n, (j + 0.5) / n, (k + 0.5) / n})] +=
            std::pow(n, -3);
  return volumes;
}

void expect_volumes(const TetMesh& mesh, const std::vector<Function>& functions, int n,
                    double tolerance) {
  const auto exact = quadrature(functions, n);
  const auto volumes = count(mesh).volume_of_ref;
  for (const auto& [ref, volume] : exact) {
    const auto found = volumes.find(ref);
    EXPECT_NEAR(found == volumes.end() ? 0 : found->second, volume, tolerance) << ref;
  }
  for (const auto& [ref, volume] : volumes) {
    EXPECT_TRUE(exact.contains(ref) || volume < tolerance) << ref;
  }
}

/// The rank of the level set whose zero two materials have in common: of the first of the two.
std::int32_t first_of(std::int32_t a, std::int32_t b) {
  return a == 2 ? b : b == 2 ? a : std::min(a, b);
}

/// Triangles inside of the box are those between materials, with the reference of the level set
/// whose zero they are, and materials' surfaces are closed; manifold, too, if they are not to meet
/// along an edge only.
void expect_interfaces(const TetMesh& mesh, bool is_manifold) {
  std::map<std::int32_t, std::map<std::pair<VertexId, VertexId>, int>> uses;
  for (const Triangle& s : mesh.triangles) {
    std::set<std::int32_t> refs;
    for (const FaceLink& side : s.sides)
      if (side.is_tet()) refs.insert(mesh.tet_refs[side.tet()]);
    if (refs.size() == 2) {
      EXPECT_EQ(s.ref, 7 + first_of(*refs.begin(), *refs.rbegin()));
    }
    for (const std::int32_t ref : refs)
      for (int k = 0; k < 3; ++k) ++uses[ref][std::minmax(s.v[k], s.v[(k + 1) % 3])];
  }
  for (const auto& [ref, of_edge] : uses)
    for (const auto& [edge, n] : of_edge) {
      EXPECT_TRUE(is_manifold ? n == 2 : n % 2 == 0) << n << " triangles of " << ref;
    }
}

double farthest_vertex(const TetMesh& mesh, const std::vector<Function>& functions) {
  double most = 0;
  for (const Triangle& s : mesh.triangles)
    for (std::size_t k = 0; k < functions.size(); ++k)
      for (const VertexId v : s.v)
        if (s.ref == 10 + std::int32_t(k))
          most = std::max(most, std::abs(functions[k](mesh.points[v])));
  return most;
}

StackResult remeshed(const std::vector<Function>& functions, double hausd, int threads,
                     Report* report = nullptr) {
  const auto stack = stack_of(functions, {hausd / 2, hausd});
  StackResult result;
  run_in_arena(threads, [&] { result = mesh_level_sets(kUnit, stack); });
  std::vector<MeshedLevelSet> meshed;
  Options options;
  options.hausd = hausd;
  options.max_bulge = 3 * hausd;
  for (std::size_t k = 0; k < stack.size(); ++k) {
    meshed.push_back({stack[k].level_set, interface_ref({}, k)});
    options.max_bulge = std::max(*options.max_bulge, result.reports[k].needed_bulge());
  }
  options.threads = threads;
  options.detect_ridges = false;
  options.finish = [&](TetMesh& mesh) { project_onto(mesh, meshed); };
  const Report done = remesh(result.mesh, {}, options);
  if (report) *report = done;
  return result;
}

TEST(Stack, OfBallsGivesEachWhatTheEarlierOnesLeave) {
  const auto functions = three_balls();
  const StackResult cut = mesh_level_sets(kUnit, stack_of(functions, {0.0005, 1e-3}));
  expect_sound(cut.mesh);
  expect_interfaces(cut.mesh, true);
  expect_volumes(cut.mesh, functions, 100, kArea * 0.0005);
  EXPECT_EQ(count(cut.mesh).tets_of_ref.size(), 4u);
  EXPECT_EQ(cut.reports.size(), 3u);
  for (const CutReport& report : cut.reports) EXPECT_FALSE(report.open);
}

TEST(Stack, IsOnItsLevelSetsWhenRemeshed) {
  const auto functions = three_balls();
  const TetMesh mesh = remeshed(functions, 0.002, 2).mesh;
  expect_sound(mesh);
  expect_interfaces(mesh, true);
  expect_volumes(mesh, functions, 100, kArea * 0.002 / 2);
  EXPECT_LT(farthest_vertex(mesh, functions), 1e-6);
  EXPECT_GT(quality_statistics(mesh).worst, 0.25);
  for (std::size_t k = 0; k < functions.size(); ++k)
    EXPECT_LT(distance_from(mesh, with_gradient({functions[k], {}}, 1), 10 + std::int32_t(k)),
              0.002);
}

TEST(Stack, IsTheSameAtAnyNumberOfThreads) {
  const auto functions = three_balls();
  const TetMesh expected = remeshed(functions, 0.008, 1).mesh;
  for (const int threads : {2, 3, 8}) {
    const TetMesh mesh = remeshed(functions, 0.008, threads).mesh;
    EXPECT_EQ(mesh.tets, expected.tets) << threads;
    EXPECT_EQ(mesh.points, expected.points) << threads;
    EXPECT_EQ(mesh.tet_refs, expected.tet_refs) << threads;
  }
}

TEST(Stack, OfRandomWavesIsConformingClosedAndOfItsVolumes) {
  constexpr int kSeeds = kSanitized ? 5 : 60;
  constexpr double kCell = 1.0 / 14;  // a sixth of the shortest wave
  for (int seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::uint64_t(seed) + 5000};
    const std::vector<Function> functions = {Waves(random), Waves(random)};
    const auto exact = quadrature(functions, 28);
    if (std::ranges::any_of(std::array{2, 3, 4}, [&](std::int32_t ref) {
          return !exact.contains(ref) || exact.at(ref) < 0.01;
        }))
      continue;
    auto stack = stack_of(functions, {0.05, 0.17});
    std::vector<std::vector<OrientedPoint>> zeros;
    for (const StackedLevelSet& s : stack)
      zeros.push_back(zeros_on_lattice(s.level_set, kUnit, kCell));
    for (std::size_t k = 0; k < stack.size(); ++k) stack[k].zeros = zeros[k];
    const StackResult cut = mesh_level_sets(kUnit, stack);
    expect_sound(cut.mesh);
    expect_interfaces(cut.mesh, false);
    expect_volumes(cut.mesh, functions, 28, 0.02);
    // What the first cut leaves of a tet the second one may make flatter by its least share again.
    EXPECT_GT(quality_statistics(cut.mesh).worst, kFlat * kLeastCutShare);
  }
}

TEST(Stack, OfRandomWavesStaysItselfWhenRemeshed) {
  for (int seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::uint64_t(seed) + 5000};
    const std::vector<Function> functions = {Waves(random), Waves(random)};
    Report report;
    const TetMesh mesh = remeshed(functions, 0.01, 2, &report).mesh;
    expect_sound(mesh);
    expect_interfaces(mesh, false);
    expect_volumes(mesh, functions, 40, 0.015);
    EXPECT_NEAR(volume(mesh), 1, 1e-9);
    // Random waves meet each other and the box at any angle.
    for (const StubbornTet& tet : report.stubborn)
      if (tet.quality < 0.1) {
        EXPECT_NE(tet.reason, "") << tet.quality;
      }
  }
}

TEST(Stack, MayTouchWithAWholeSurface) {
  const Function lower = [](const Vec3& p) { return std::max(sphere(p), p.x - 0.51234); };
  const Function upper = [](const Vec3& p) { return std::max(sphere(p), 0.51234 - p.x); };
  const StackResult cut = mesh_level_sets(kUnit, stack_of({lower, upper}, {0.001, 0.01}));
  expect_sound(cut.mesh);
  EXPECT_GT(quality_statistics(cut.mesh).worst, kFlat);
  const auto volumes = count(cut.mesh).volume_of_ref;
  EXPECT_NEAR(volumes.at(3) + volumes.at(4), 0.113097, kArea * 0.001);
  EXPECT_NEAR(volumes.at(3) - volumes.at(4), 2 * 0.01234 * std::numbers::pi * 0.09, 0.0005);
}

TEST(Stack, KeepsOneSideOfAllOfThem) {
  const auto functions = three_balls();
  const auto stack = stack_of(functions, {0.002, 1e-2});
  CutOptions options;
  options.keep = CutKeep::kInside;
  const TetMesh inside = mesh_level_sets(kUnit, stack, options).mesh;
  expect_sound(inside);
  EXPECT_EQ(count(inside).tets_of_ref.size(), 3u);
  EXPECT_FALSE(count(inside).tets_of_ref.contains(2));
  EXPECT_EQ(count(inside).components, 1);
  options.keep = CutKeep::kOutside;
  const TetMesh outside = mesh_level_sets(kUnit, stack, options).mesh;
  EXPECT_EQ(count(outside).tets_of_ref.size(), 1u);
  EXPECT_NEAR(volume(inside) + volume(outside), 1, 1e-12);
}

TEST(Stack, RefusesWhatIsNone) {
  auto stack = stack_of({ball({0.5, 0.5, 0.5}, 0.3), ball({0.5, 0.5, 0.5}, 0.2)}, {0.01, 0.02});
  stack[1].name = "the core";
  EXPECT_THROW(
      {
        try {
          mesh_level_sets(kUnit, stack);
        } catch (const InputError& e) {
          EXPECT_EQ(std::string(e.what()),
                    "the core: nothing of its inside is outside of the level sets before it");
          throw;
        }
      },
      InputError);
  CutOptions options;
  options.material.outside = 4;
  EXPECT_THROW(mesh_level_sets(kUnit, stack, options), OptionError);
  options.material.outside = 2;
  options.material_of_ref[1] = {};
  EXPECT_THROW(mesh_level_sets(kUnit, stack, options), OptionError);
}

}  // namespace
}  // namespace cavea::test
