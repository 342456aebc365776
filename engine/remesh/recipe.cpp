#include "cavea/remesh/recipe.h"

#include <memory>
#include <utility>

#include "cavea/geometry/metric.h"
#include "cavea/remesh/standing.h"

namespace cavea {
namespace {

/// Operators keep this share of the tolerance, so that what lies between their sample points stays
/// within all of it.
constexpr double kOperatorShare = 0.8;
/// What is left after a round is near the ideal surface already; if less of the tolerance may be
/// used from then on, half as many places are found too far off in the end, where repairs make
/// sizes smaller. Not where facets are the truth: what lies beside their bends is then held fast.
constexpr double kLaterShare = 0.75;

/// Surface edges of at least this many hmin are split where they do not fit the surface.
constexpr double kFittedEdge = 1.5;

/// The paper's rough bounds of lengths (section 4.3, step 4).
constexpr double kRoughLong = 2.0, kRoughShort = 0.4;

/// Lengths between seeds are no farther off than this where it is for swaps and relocation to mend.
constexpr double kEvenedOut = 1.25;

/// Each level makes twice the tets, of which few are at the interface: parts pay early.
constexpr std::int64_t kOneSurfacePart = 2000;

/// Each level halves the longest edges of the surface; as many as in bulk.
constexpr int kMostSurfaceLevels = 16;

CycleSettings base(const ResolvedOptions& o) {
  CycleSettings s;
  s.limits.tolerance_share = kOperatorShare;
  s.limits.surface_frozen = o.freeze.surface;
  s.shortest_fitted = o.uniform() || o.freeze.surface ? 0 : kFittedEdge * o.smallest;
  s.insert = !o.freeze.insert;
  s.collapse = !o.freeze.collapse;
  s.swap = !o.freeze.swap;
  s.move = !o.freeze.move;
  return s;
}

/// Lengths outside the rough bounds only, with loss of quality allowed.
Phase rough(const ResolvedOptions& o) {
  Phase p{"rough", base(o), {}, 2, 0.05, 8};
  p.cycle.limits.long_edge = kRoughLong;
  p.cycle.limits.short_edge = kRoughShort;
  p.cycle.limits.quality_ratio = 0.3;
  p.cycle.limits.quality_floor = 0.1;
  p.cycle.sweeps = 4;
  p.cycle.swap_ceiling = 0.5;
  p.cycle.repair_below = 0.1;
  return p;
}

Phase fine(const ResolvedOptions& o) {
  Phase p{"fine", base(o), {}, 3, 0.035, 8};
  p.cycle.shake_below = 0.72;
  p.ask = tet_flag::kAskLength;
  p.cycle.limits.shortest_made = 0.6;
  p.cycle.limits.quality_ratio = 0.7;
  p.cycle.limits.quality_floor = 0.3;
  p.budget_rounds = 4;
  p.later = LaterLimits{true, o.max_bulge > 0 ? kLaterShare : kOperatorShare};
  p.cycle.sweeps = 5;
  p.cycle.swap_ceiling = 0.75;
  p.cycle.repair_below = 0.2;
  return p;
}

Phase polish(const ResolvedOptions& o) {
  Phase p{"polish", base(o), {}, 2, 0.005, 0};
  p.cycle.limits.shortest_made = kShortEdge;
  p.cycle.limits.leave_tolerated = true;
  p.cycle.limits.ears_go = true;  // earlier phases move the surface, and most ears are gone after
  p.cycle.limits.quality_ratio = 0.9;
  p.cycle.limits.quality_floor = 0.4;
  p.cycle.sweeps = 4;
  // In shells of better tets alone, hardly any swap raises the worst by enough.
  p.cycle.swap_ceiling = 0.75;
  // Nor does moving vertices of good tets, but it wakes all around.
  p.cycle.move_ceiling = 0.75;
  p.cycle.repair_below = 0.45;
  p.cycle.reconnect_below = p.ask_below = 0.5;
  p.resize = false;
  // Few are asked, all over the mesh: with a second layer they would take all of it to the parts.
  p.layers = 1;
  return p;
}

/// Of a mesh that is good already, but for the few places where it is not: what better tets gain
/// from swaps and moves takes more time than all before.
void leave_good(Phase& adapt, Phase& finish) {
  adapt.rounds = 1;
  adapt.cycle.sweeps = 3;
  adapt.cycle.swap_ceiling = 0.7;
  adapt.cycle.move_ceiling = 0.75;
  finish.cycle.swap_ceiling = finish.cycle.move_ceiling = 0.5;
  // At once, without other parts for it: what interfaces hold back is left to the rounds that
  // follow.
  CycleSettings next = finish.cycle;
  next.ask_below = finish.ask_below;
  adapt.cycle.next = std::make_shared<const CycleSettings>(std::move(next));
}

}  // namespace

Phase surfacing(const ResolvedOptions& o) {
  Phase p = rough(o);
  p.name = "surface";
  p.rounds = kMostSurfaceLevels;
  p.one_part = kOneSurfacePart;
  p.settled = 0.02;
  p.cycle.sweeps = 1;
  p.cycle.delaunay_splits = true;
  p.cycle.collapse = p.cycle.swap = p.cycle.move = false;
  p.cycle.repair_below = 0;
  return p;
}

Phase thinning(const ResolvedOptions& o) {
  Phase p = rough(o);
  p.name = "thinning";
  p.cycle.sweeps = 3;
  p.cycle.insert = p.cycle.move = false;
  p.cycle.limits.short_edge = 0.6;
  p.cycle.repair_below = 0;
  // Its vertices are old ones, where sizes stay the same.
  p.resize = false;
  p.layers = 1;
  return p;
}

std::vector<Phase> mending_recipe(const ResolvedOptions& o) {
  Phase adapt = fine(o), finish = polish(o);
  adapt.rounds = 2;
  adapt.ask = 0;
  adapt.resize = false;  // lest all be asked for sizes that are a little other
  adapt.cycle.shake_below = 0;
  finish.rounds = 1;
  finish.ask_below = 0;  // what was not asked is as good as it gets
  finish.layers = kLayers;
  // What is asked is little of the whole, and is to be mended to the end.
  for (Phase* p : {&adapt, &finish}) p->settled = p->cycle.settled = 0;
  return {adapt, finish};
}

std::vector<Phase> standing_recipe(const ResolvedOptions& o) {
  std::vector<Phase> phases = mending_recipe(o);
  for (Phase& p : phases)
    p.cycle.limits.long_edge = kRoughLong, p.cycle.limits.short_edge = kRoughShort;
  return holding_good(std::move(phases));
}

std::vector<Phase> poor_recipe(const ResolvedOptions& o) {
  Phase loose = rough(o);
  loose.rounds = 1;
  loose.resize = false;
  loose.settled = loose.cycle.settled = 0;
  loose.cycle.repair_below = 0.2;
  std::vector<Phase> phases = mending_recipe(o);
  phases.insert(phases.begin(), loose);
  return phases;
}

std::vector<Phase> asking_poor(std::vector<Phase> phases) {
  for (Phase& p : phases) p.ask_below = kPoorQuality;
  return phases;
}

CycleSettings detour_cycle(const ResolvedOptions& o) {
  CycleSettings first = rough(o).cycle, last = polish(o).cycle;
  first.repair_below = 0.2;
  last.limits.long_edge = kRoughLong, last.limits.short_edge = kRoughShort;
  first.settled = last.settled = 0;
  first.next = std::make_shared<const CycleSettings>(last);
  return first;
}

std::vector<Phase> holding_good(std::vector<Phase> phases) {
  // With less, mended tets stay below 0.5, which moves around them would cure.
  constexpr double kGood = 0.6;
  for (Phase& p : phases) p.cycle.move_ceiling = kGood;
  return phases;
}

std::vector<Phase> recipe(const ResolvedOptions& o, Seeds seeds) {
  if (seeds == Seeds::kAbsent) return {rough(o), fine(o), polish(o)};
  Phase first = fine(o);
  if (seeds >= Seeds::kMost) first.cycle.first_slack = kEvenedOut;
  if (seeds >= Seeds::kNearlyAll) {
    // Lattices need no shaking, and little of the whole is left for a third round.
    first.cycle.shake_below = 0;
    first.rounds = 2;
  }
  first.ask = 0;  // all are asked, but those that are trusted
  Phase last = polish(o);
  if (seeds == Seeds::kEven) leave_good(first, last);
  return {first, last};
}

Phase last_phase(const ResolvedOptions& o) { return polish(o); }

}  // namespace cavea
