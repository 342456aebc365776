#include "cavea/remesh/mending.h"

#include <cmath>

#include "cavea/remesh/asking.h"
#include "cavea/remesh/rounds.h"
#include "cavea/remesh/standing.h"

namespace cavea {

void mend_poor(Job& job) {
  constexpr int kMends = 5;
  if (job.keeping.leaves_all()) return;
  const std::vector<Phase> phases =
      asking_poor(job.keeping.stands ? holding_good(poor_recipe(job.r)) : poor_recipe(job.r));
  std::int64_t poor = count_poor(job.mesh);
  for (int k = 0; k < kMends && poor > 0; ++k) {
    ask_nothing(job.mesh);
    ask_poor(job.mesh);
    job.steps.timed("mending", [&] { run_phases(job, phases); });
    const std::int64_t left = count_poor(job.mesh);
    if (stays_poor(left, poor)) break;
    poor = left;
  }
}

bool stays_poor(std::int64_t left, std::int64_t poor) {
  constexpr double kMended = 0.9;
  return double(left) > kMended * double(poor);
}

bool mended_by_chance(std::int64_t left, std::int64_t poor) {
  constexpr double kByChance = 3;  // standard deviations of such a number
  const double cured = double(poor - left);
  return stays_poor(left, poor) ||
         (cured < 0.5 * double(poor) && cured < kByChance * std::sqrt(double(poor)));
}

}  // namespace cavea
