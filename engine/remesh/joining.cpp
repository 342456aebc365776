#include "cavea/remesh/joining.h"

#include <optional>
#include <utility>
#include <vector>

#include "cavea/mesh/fill_holes.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/attempt.h"
#include "cavea/remesh/joiner.h"
#include "cavea/remesh/recipe.h"
#include "cavea/remesh/reference_regions.h"
#include "cavea/remesh/rounds.h"

namespace cavea {
namespace {

/// Where more of the tets are unsound, narrow strips are not the reason (seen is a success with
/// 0.012): a budget that is far too small leaves 0.08, an edge of 6 degrees all along a blade 0.05.
constexpr double kMostUnsound = 0.02;

/// What is changed is mended like all, and may leave more to join.
void join_and_mend(Job& job, bool surface_frozen, const std::vector<FailedPlace>& failed,
                   std::optional<Before>& before) {
  constexpr int kRounds = 5;
  std::vector<Phase> phases = poor_recipe(job.r);
  for (Phase& p : phases) p.cycle.limits.surface_frozen |= surface_frozen;
  const auto keep_first = [&] {
    if (!before) before.emplace(job);
  };
  for (int round = 0; round < kRounds; ++round) {
    ask_nothing(job.mesh);
    if (Joiner(job, failed).run(keep_first) == 0) return;
    fill_holes(job.mesh, &job.report.part_of_tet);
    run_phases(job, phases);
  }
}

/// As long as that fails somewhere, the next trial moves less there.
void try_joining(Job& job, bool surface_frozen, SurfaceDistance& distance,
                 const std::function<SurfaceDistance()>& measure) {
  constexpr int kTrials = 6;
  // Each round may move a curve by the tolerance; where that adds up, a region has lost its place.
  constexpr double kRegionReach = 2;  // hausd
  const ReferenceRegions regions(job.mesh);
  const Standard standard = standard_of(job.mesh, distance, find_crossings(job.mesh).size());
  std::vector<FailedPlace> failed;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::optional<Before> before;
    job.steps.timed("joining", [&] { join_and_mend(job, surface_frozen, failed, before); });
    if (!before) return;
    SurfaceDistance after = measure();
    const std::vector<Crossing> crossings = find_crossings(job.mesh);
    const std::vector<FailedPlace> lost = regions.lost_from(job.mesh, kRegionReach * job.r.hausd);
    if (lost.empty() && standard.is_met(job.mesh, after, crossings))
      return void(distance = std::move(after));
    std::vector<FailedPlace> now = standard.failures(job.mesh, after, crossings);
    now.insert(now.end(), lost.begin(), lost.end());
    std::move(*before).give_back(job);
    if (now.empty()) return;  // nobody knows where to do otherwise
    failed.insert(failed.end(), now.begin(), now.end());
  }
}

}  // namespace

void join_surface(Job& job, SurfaceDistance& distance,
                  const std::function<SurfaceDistance()>& measure) {
  const Freezes& freeze = job.r.freeze;
  if (job.keeping.stands || freeze.join || freeze.collapse || freeze.insert || freeze.surface)
    return;
  // What operators do to the surface beside may add up to too much: then they leave it alone.
  for (const bool surface_frozen : {false, true}) {
    const std::size_t unsound = unsound_tets(job.mesh).size();
    if (unsound == 0 || double(unsound) > kMostUnsound * double(job.mesh.tets.size())) return;
    job.input.keep(job.mesh);
    try_joining(job, surface_frozen, distance, measure);
  }
}

}  // namespace cavea
