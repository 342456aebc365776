#include "cavea/remesh/rounds.h"

#include <algorithm>
#include <atomic>
#include <memory>

#include "cavea/base/ids_where.h"
#include "cavea/mesh/statistics.h"
#include "cavea/part/round.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/forecast.h"
#include "cavea/remesh/room.h"

namespace cavea {
namespace {

/// The same for cycles that follow.
CycleSettings with_cancel(CycleSettings settings, const std::atomic<bool>* cancel) {
  settings.cancel = cancel;
  if (settings.next)
    settings.next = std::make_shared<const CycleSettings>(with_cancel(*settings.next, cancel));
  return settings;
}

CycleSettings settings_of(const Job& job, const Phase& phase) {
  return with_cancel(phase.cycle, job.options.cancel);
}

/// Whether needles are more of the mesh than interfaces may hold back: poor ones that stay between
/// parts are asked all that can be asked in each sweep, round and phase that follows.
bool is_full_of_needles(const TetMesh& mesh) {
  constexpr float kNeedle = 0.1f;
  constexpr double kMany = 0.002;
  const std::int64_t needles =
      count_where(mesh.tets.size(), [&](TetId t) { return mesh.qualities[t] < kNeedle; });
  return double(needles) > kMany * double(mesh.tets.size());
}

void tighten(Limits& limits, const LaterLimits& later) {
  limits.leave_tolerated |= later.leave_tolerated;
  limits.tolerance_share = std::min(limits.tolerance_share, later.tolerance_share);
}

PartSize part_size(const Job& job, const Phase& phase) {
  PartSize size{job.options.tets_per_part};
  if (phase.one_part > 0) size.one_part = phase.one_part;
  size.layers = phase.layers;
  size.few = size.tets_per_part == 0 && is_full_of_needles(job.mesh);
  return size;
}

std::int64_t most_tets_of_part(const Job& job, const Phase& phase, const PartSize& size) {
  const std::int64_t tets = std::int64_t(job.mesh.tets.size());
  return std::int64_t(phase.growth * double(tets) / part_count(tets, size)) + 10000;
}

bool is_to_go_on(const Job& job, const Phase& phase, int round) {
  return round <= phase.rounds ||
         (round <= phase.rounds + phase.budget_rounds && !job.sizes.budget().met(job.mesh));
}

/// Whether a phase may end after a round with this result.
bool is_settled(const Job& job, const Phase& phase, const CycleResult& result) {
  return !result.full && (phase.budget_rounds == 0 || job.sizes.budget().met(job.mesh)) &&
         double(result.changes) < phase.settled * double(job.mesh.tets.size());
}

/// Whether the rounds before have left nothing to ask.
bool is_all_done(const Job& job) {
  return job.report.part_of_tet.size() == job.mesh.tets.size() && is_nothing_asked(job.mesh);
}

}  // namespace

void run_phase(Job& job, const Phase& phase) {
  TetMesh& mesh = job.mesh;
  CycleSettings settings = settings_of(job, phase);
  if (phase.ask > 0) ask_all(mesh, phase.ask);
  if (phase.ask_below > 0) ask_below(mesh, phase.ask_below);
  for (int round = 1; is_to_go_on(job, phase, round); ++round) {
    job.steps.tell(phase.name, round);
    refuse_too_large(mesh, job.most_bytes);
    if (phase.resize && round > 1 && job.sizes.vary())
      job.resize(), ask_all(mesh, tet_flag::kAskLength);
    if (is_all_done(job)) break;
    if (round > 1 && phase.later && mean_quality(mesh) >= kRoomyMean)
      tighten(settings.limits, *phase.later);
    const PartSize size = part_size(job, phase);
    if (phase.growth > 0) settings.most_tets = most_tets_of_part(job, phase, size);
    const RoundResult result =
        run_round(mesh, job.surface.working_model(), settings, &job.report.part_of_tet, size);
    job.report.parts = std::max(job.report.parts, result.parts);
    job.verdicts += result.cycle.verdicts;
    if (phase.budget_rounds > 0) job.sizes.budget().learn(mesh);
    if (is_settled(job, phase, result.cycle)) break;
  }
}

void run_residual_of(Job& job, const Phase& last) {
  job.report.residual += run_residual(job.mesh, job.surface.working_model(), settings_of(job, last),
                                      job.report.part_of_tet, job.verdicts);
}

void run_phases(Job& job, const std::vector<Phase>& phases) {
  for (const Phase& phase : phases) run_phase(job, phase);
  run_residual_of(job, phases.back());
}

}  // namespace cavea
