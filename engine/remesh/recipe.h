#pragma once
#include <optional>
#include <vector>

#include "cavea/part/region.h"
#include "cavea/pass/cycle.h"
#include "cavea/remesh/resolved.h"

namespace cavea {

/// Stricter limits from the second round of a phase on, in a mesh that has a mean quality of
/// kRoomyMean by then: bodies with less room want all there is.
struct LaterLimits {
  /// No edge is split that a collapse would undo. In the first round that finds better vertices,
  /// then it is the same pairs over and over.
  bool leave_tolerated = false;
  double tolerance_share = 1;
};

/// One phase of the recipe: rounds of the same settings until little changes.
struct Phase {
  const char* name;
  CycleSettings cycle;
  std::optional<LaterLimits> later;
  int rounds = 1;
  /// Ends before its last round when a round changes fewer than this share of the tets.
  double settled = 0.01;
  /// A part may grow this many times before the mesh is partitioned anew; 0: without bound.
  double growth = 0;
  /// Asked of all tets again at the start, because this phase's limits differ from those before.
  std::uint8_t ask = 0;
  /// The same of tets of a lower quality, to which this phase offers more than those before.
  double ask_below = 0;
  /// A mesh of fewer tets is one part; 0: as run_round() has it.
  std::int64_t one_part = 0;
  int layers = kLayers;  ///< of tets around those that are asked
  bool resize = true;    ///< sets the wanted sizes anew before each round
  /// More rounds than `rounds` while the number of tets is not the budget's; after each round it
  /// tells what sizes come to.
  int budget_rounds = 0;
};

/// How many of a mesh's vertices are seeds; kAbsent where it was not filled with them at all,
/// kEven where nearly all are and it is about as good as needed already.
enum class Seeds { kAbsent, kSome, kMost, kNearlyAll, kEven };

/// The phases of section 4.3: rough sampling of the surface, rough and fine adaptation to the
/// sizes, and a last polish of quality. Nothing is rough in a mesh that is thinned and filled with
/// seeds.
std::vector<Phase> recipe(const ResolvedOptions& options, Seeds seeds);

/// The phase before that: long edges of the surface are halved, level by level.
Phase surfacing(const ResolvedOptions& options);

/// The phase before seeds: collapses what is far too fine, so that they find room, and swaps what
/// is flat.
Phase thinning(const ResolvedOptions& options);

/// The last phase, which offers everything to poor tets.
Phase last_phase(const ResolvedOptions& options);

/// The phases that mend an almost finished mesh in the places that are asked.
std::vector<Phase> mending_recipe(const ResolvedOptions& options);

/// The same for a mesh that stands: only lengths that no result has are changed.
std::vector<Phase> standing_recipe(const ResolvedOptions& options);

/// The same for poor tets that the limits of those phases hold fast: rough ones come first.
std::vector<Phase> poor_recipe(const ResolvedOptions& options);

/// The same phases, but each asks all poor tets of the mesh, since it offers them more than those
/// before.
std::vector<Phase> asking_poor(std::vector<Phase> phases);

/// Cycles that mend what one operation out of the way has left: rough ones, then polish, with the
/// lengths of rough, lest it is undone.
CycleSettings detour_cycle(const ResolvedOptions& options);

/// The same phases, but vertices of good tets stay: moving them spreads from ball to ball around
/// what is mended, which a mesh that stands has no need of.
std::vector<Phase> holding_good(std::vector<Phase> phases);

}  // namespace cavea
