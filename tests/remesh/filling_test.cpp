// How the surface is refined before the volume is filled.
#include "cavea/remesh/filling.h"

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

}  // namespace
}  // namespace cavea::test
