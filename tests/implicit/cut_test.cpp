#include "cavea/implicit/cut.h"

#include <numbers>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/statistics.h"
#include "cavea/remesh/remesh.h"
#include "level_sets.h"
#include "support/expect.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

/// Volume where the P1 function is negative, by the known formula of a tet cut by a plane.
double exact_volume_below(const TetMesh& mesh, const std::vector<double>& values) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    std::vector<double> low, high;
    for (const VertexId v : mesh.tets[t]) (values[v] < 0 ? low : high).push_back(values[v]);
    const auto corner = [](double at, const std::vector<double>& others) {
      double share = 1;
      for (const double o : others) share *= at / (at - o);
      return share;
    };
    double share = 0;
    if (low.size() == 4) share = 1;
    if (low.size() == 1) share = corner(low[0], high);
    if (low.size() == 3) share = 1 - corner(high[0], low);
    if (low.size() == 2) {
      const double p = low[0] / (low[0] - high[0]), q = low[0] / (low[0] - high[1]);
      const double r = low[1] / (low[1] - high[0]), s = low[1] / (low[1] - high[1]);
      share = p * q + r * s * (1 - q) + r * q * (1 - p);  // the prism as three tets
    }
    sum += share * volume6(a, b, c, d) / 6;
  }
  return sum;
}

TEST(Cut, OfRandomWavesIsConformingClosedAndOfTheirVolume) {
  const TetMesh cube = build(kuhn_cube(kSanitized ? 5 : 8)).mesh;
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random{std::uint64_t(seed)};
    const bool rounded = seed % 4 == 0;
    // Rounded, they have a zero at many vertices: snapping is then at its hardest.
    const std::vector<double> values =
        values_of(cube, [waves = Waves(random), rounded](const Vec3& p) {
          return rounded ? std::round(waves(p) * 2) / 2 : waves(p);
        });
    if (std::ranges::min(values) >= 0 || std::ranges::max(values) <= 0) continue;
    const CutResult cut = cut_along(cube, values);
    expect_sound(cut.mesh);
    expect_closed_manifold(cut.mesh);
    const auto volumes = count(cut.mesh).volume_of_ref;
    EXPECT_NEAR(volumes.at(2) + volumes.at(3), 1, 1e-12);
    EXPECT_GT(quality_statistics(cut.mesh).worst, kFlat);
    // The interface moves by a hundredth of an edge at most, and its area is a few of the cube's.
    if (!rounded) {
      EXPECT_NEAR(volumes.at(3), exact_volume_below(cube, values), 0.01);
    }
  }
}

TEST(Cut, IsTheSameAtAnyNumberOfThreads) {
  const TetMesh cube = build(kuhn_cube(8)).mesh;
  Random random(7);
  const std::vector<double> values = values_of(cube, Waves(random));
  TetMesh one, three;
  run_in_arena(1, [&] { one = cut_along(cube, values).mesh; });
  run_in_arena(3, [&] { three = cut_along(cube, values).mesh; });
  expect_same(one, three);
}

TEST(Cut, AlongAFunctionIsOnItsZeroAndStaysThereWhenRemeshed) {
  const TetMesh cube = build(kuhn_cube(10)).mesh;
  CutResult cut = cut_along(cube, sphere);
  TetMesh& mesh = cut.mesh;
  EXPECT_NEAR(cut.report.sagitta, 0.01 * 3 / 8 / 0.3, 0.005);  // of edges of 0.17 at most
  const auto farthest = [&] {
    double most = 0;
    for (const Triangle& s : mesh.triangles)
      for (const VertexId v : s.v)
        if (s.ref == 10) most = std::max(most, std::abs(sphere(mesh.points[v])));
    return most;
  };
  EXPECT_LT(farthest(), 0.01 * std::numbers::sqrt3 / 10);  // kLeastCutShare of the longest edge
  Options options;
  options.hausd = 0.002;
  options.hmax = 0.1;
  options.max_bulge = cut.report.needed_bulge();
  remesh(mesh, {}, options);
  expect_sound(mesh);
  EXPECT_LT(farthest(), 0.002);
}

TEST(Cut, SplitsMaterialsByTheirOwnReferences) {
  MeshData data = kuhn_cube(6);
  for (std::size_t t = 0; t < data.tets.size(); ++t)
    data.tet_refs[t] = data.vertices[data.tets[t][0]].z < 0.5 ? 5 : 6;
  const TetMesh cube = build(data).mesh;
  CutOptions options;
  options.material_of_ref[5] = {true, 50, 51};
  options.material_of_ref[6] = {false, 0, 0};
  const CutResult cut = cut_along(cube, values_of(cube, sphere), options);
  expect_sound(cut.mesh);
  const auto tets = count(cut.mesh).tets_of_ref;
  EXPECT_EQ(tets.size(), 3u);
  for (const int ref : {6, 50, 51}) EXPECT_TRUE(tets.contains(ref)) << ref;
}

TEST(Cut, KeepsOneSideAndDropsSmallComponents) {
  const TetMesh cube = build(kuhn_cube(12)).mesh;
  const auto two = [](const Vec3& p) {
    return std::min(sphere(p), norm(p - Vec3{0.12, 0.12, 0.12}) - 0.1);
  };
  CutOptions options;
  options.keep = CutKeep::kInside;
  EXPECT_EQ(count(cut_along(cube, two, options).mesh).components, 2);
  options.remove_components = 0.02;
  const CutResult cut = cut_along(cube, two, options);
  EXPECT_EQ(count(cut.mesh).components, 1);
  EXPECT_EQ(cut.report.removed_components, 1);
  EXPECT_FALSE(cut.report.open);
  const auto hollow = [&](const Vec3& p) { return -two(p); };
  options.keep = CutKeep::kOutside;
  options.remove_components = 0.2;
  EXPECT_THROW(cut_along(cube, hollow, options), InputError);  // all outside was cavities
}

void expect_refused(const TetMesh& mesh, const std::vector<double>& values, double isovalue,
                    const std::string& named) {
  CutOptions options;
  options.isovalue = isovalue;
  try {
    cut_along(mesh, values, options);
    ADD_FAILURE() << "not refused: " << named;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(named), std::string::npos) << e.what();
  }
}

TEST(Cut, RefusesWhatIsNoLevelSet) {
  const TetMesh cube = build(kuhn_cube(2)).mesh;
  std::vector<double> values = values_of(cube, [](const Vec3& p) { return p.x + p.y; });
  expect_refused(cube, values, 3, "from 0 to 2");
  expect_refused(cube, values, 0, "nowhere");
  values[4] = NAN;
  expect_refused(cube, values, 1, "vertex 5");
  values.pop_back();
  expect_refused(cube, values, 1, "26 values for 27 vertices");
}

TEST(Cut, RefusesToCutWhatIsRequired) {
  MeshData data = kuhn_cube(2);
  data.required_tets = {0};
  const TetMesh cube = build(data).mesh;
  std::vector<double> values = values_of(cube, [](const Vec3& p) { return p.x; });
  expect_refused(cube, values, 0.3, "required tet 1");
}

}  // namespace
}  // namespace cavea::test
