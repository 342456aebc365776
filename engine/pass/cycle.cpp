#include "cavea/pass/cycle.h"

#include "cavea/base/cancel.h"
#include "cavea/pass/passes.h"

namespace cavea {
namespace {

/// The limits of the lengths in a sweep.
void set_lengths(PartState& state, int sweep) {
  const CycleSettings& s = state.settings;
  state.slack = sweep == 0 && s.first_slack > 1;
  const double slack = state.slack ? s.first_slack : 1;
  state.context.limits.long_edge = s.limits.long_edge * slack;
  state.context.limits.short_edge = s.limits.short_edge / slack;
}

CycleResult run_one(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings) {
  if (settings.ask_below > 0) ask_below(mesh, settings.ask_below);
  for (std::uint8_t& flags : mesh.tet_flags) flags &= std::uint8_t(~tet_flag::kBlocked);
  PartState state(mesh, surface, settings);
  for (int sweep = 0; sweep < settings.sweeps; ++sweep) {
    throw_if_cancelled(settings.cancel);
    std::int64_t changes = 0;
    set_lengths(state, sweep);
    if (settings.insert)
      changes += settings.delaunay_splits ? surface_pass(state) : split_pass(state);
    if (settings.collapse) changes += collapse_pass(state);
    if (sweep == 0 && settings.move && settings.shake_below > 0) shake_pass(state);
    state.last_resorts = sweep > 0;
    changes += quality_pass(state);
    if (settings.move) changes += move_pass(state);
    const bool settled = double(changes) <= settings.settled * double(state.editor.living_tets());
    if ((settled && state.last_resorts) || state.result.full) break;
  }
  return state.result;
}

}  // namespace

void ask_below(TetMesh& mesh, double quality) {
  for (TetId t = 0; t < TetId(mesh.tets.size()); ++t)
    if (mesh.tet_alive(t) && mesh.qualities[t] < quality) mesh.tet_flags[t] |= tet_flag::kAskAll;
}

CycleResult& CycleResult::operator+=(const CycleResult& other) {
  verdicts += other.verdicts;
  changes += other.changes;
  full |= other.full;
  return *this;
}

CycleResult run_cycle(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings) {
  CycleResult result = run_one(mesh, surface, settings);
  if (settings.next && !result.full) result += run_cycle(mesh, surface, *settings.next);
  return result;
}

}  // namespace cavea
