#pragma once
#include <atomic>
#include <cstdint>
#include <memory>

#include "cavea/cavity/mesh_editor.h"
#include "cavea/operator/context.h"

namespace cavea {

/// What one run of the cycle does to a part.
struct CycleSettings {
  Limits limits;
  /// What may be done, in any pass: stars of edges insert vertices like splits, shaking moves them.
  bool insert = true, collapse = true, swap = true, move = true;
  /// Only surface edges are split, each that is there once a sweep, by the Delaunay kernel.
  bool delaunay_splits = false;
  /// Split surface edges whose middle is farther from the ideal surface than the tolerance, too,
  /// down to this Euclidean length; 0: never.
  double shortest_fitted = 0;
  int sweeps = 6;
  /// In the first sweep lengths this many times beyond the limits are left to the next one: by then
  /// swaps and relocation have evened out much of what is only a little too long or too short.
  double first_slack = 1;
  /// After a sweep that changed no more than this share of the tets the rest is left to the next
  /// round.
  double settled = 0.001;
  /// Stop splitting when the part has this many tets: it is then partitioned anew.
  std::int64_t most_tets = kMaxTets;
  /// Tets better than this are not asked for swaps.
  double swap_ceiling = 1;
  /// Only vertices with a tet worse than this are relocated.
  double move_ceiling = 1;
  /// In the first sweep, interior vertices whose ball is on the average worse than this are moved a
  /// little at random (by their place alone, not by a clock): out of regular lattices, where all
  /// tets are alike and no single operation gains.
  double shake_below = 0;
  /// Tets worse than this are also offered collapses for the sake of quality.
  double repair_below = 0;
  /// Tets worse than this are also offered a reconnection of the cavity around them.
  double reconnect_below = 0;
  /// Tets worse than this are asked everything again first.
  double ask_below = 0;
  /// Of a cycle that follows at once; null: none.
  std::shared_ptr<const CycleSettings> next;
  const std::atomic<bool>* cancel = nullptr;
};

struct CycleResult {
  VerdictTable verdicts;
  std::int64_t changes = 0;  ///< accepted operations
  bool full = false;         ///< stopped splitting at most_tets

  CycleResult& operator+=(const CycleResult& other);
};

/// Tets of a lower quality are asked everything.
void ask_below(TetMesh& mesh, double quality);

/// Runs sweeps of split, collapse, swap and relocation (paper, section 4.3) on one mesh until
/// nothing is left to do or `sweeps` are done. Serial and a function of the mesh and the settings
/// alone. Only tets flagged kAsk... are asked; the flags that remain say what is still open. The
/// result is the sum over all cycles that follow. \throw Cancelled
CycleResult run_cycle(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings);

}  // namespace cavea
