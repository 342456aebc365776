// How the surface is refined before the volume is filled.
#include "cavea/remesh/filling.h"

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "remesh/steps.h"
#include "remesh/support.h"

namespace cavea::test {
namespace {

bool was_refined_among_needles(const Report& report) { return times_of("surface", report) > 0; }

/// Twelve tets of a mean quality of 0.32. Halved until their edges are as long as the ridges of the
/// step want, they are tens of thousands of a mean of 0.003, which operators hardly get out of.
TEST(Filling, BulkThatMakesNeedlesIsTakenBack) {
  constexpr double kSmallest = 0.006;
  Options options;
  options.hmin = kSmallest, options.hausd = 1e-4;
  const Report report = report_of(step(0.15 * kSmallest), options);
  EXPECT_GT(report.before.quality.mean, 0.3);
  EXPECT_TRUE(was_refined_among_needles(report));
  EXPECT_GE(report.after.quality.mean, 0.79);
  EXPECT_LE(report.surface_distance, *options.hausd);
}

TEST(Filling, BulkOfGoodTetsIsKept) {
  EXPECT_FALSE(was_refined_among_needles(report_of(kuhn_cube(4), uniform(0.1))));
}

/// A shell of a cone, one needle high: tets from its foot to its top, three to a prism.
MeshData funnel(int sides) {
  MeshData data;
  for (const auto& [outer, wall, z] : {std::tuple{1.0, 0.05, 0.0}, {0.05, 0.05, 3.0}})
    for (const double radius : {outer + wall, outer})
      for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        data.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
      }
  const auto add_prism = [&](std::array<int, 3> foot) {
    std::ranges::sort(foot);
    const auto [a, b, c] = foot;
    const int up = 2 * sides;
    data.tets.push_back({a, b, c, c + up});
    data.tets.push_back({a, b, b + up, c + up});
    data.tets.push_back({a, a + up, b + up, c + up});
  };
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    add_prism({i, next, sides + next});
    add_prism({i, sides + i, sides + next});
  }
  data.vertex_refs.assign(data.vertices.size(), 0);
  data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

// Halving all edges would make a hundred times the tets, of a mean of 0.01.
TEST(Filling, ShellsOfNeedlesGoOnFromTheirRefinedSurface) {
  const Report report = report_of(funnel(64), {});
  EXPECT_LT(report.before.quality.mean, 0.1);
  EXPECT_TRUE(was_refined_among_needles(report));
  EXPECT_EQ(times_of("bulk", report), 0);
  EXPECT_GE(report.after.quality.mean, 0.79);
  EXPECT_GE(report.after.quality.worst, 0.4);
}

}  // namespace
}  // namespace cavea::test
