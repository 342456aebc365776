#include "cavea/remesh/run.h"

#include "cavea/base/memory.h"
#include "cavea/base/parallel.h"
#include "cavea/part/order.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/conclusion.h"
#include "cavea/remesh/filling.h"
#include "cavea/remesh/forecast.h"
#include "cavea/remesh/mending.h"
#include "cavea/remesh/repair.h"
#include "cavea/remesh/rounds.h"
#include "cavea/remesh/standing.h"

namespace cavea {

Run::Run(Input& input, const SizeField& field, const Options& options, Effort effort, double finer)
    : job_(input, field, options, finer), effort_(effort) {}

void Run::operator()() {
  job_.steps.timed("analysis", [&] { analyse(); });
  job_.keeping = keep_what_stands(job_, effort_);
  if (!job_.keeping.stands) {
    job_.steps.expect(forecast_about(job_.mesh, job_.sizes.law()));
    refuse_too_large(job_.mesh, job_.sizes.law(), job_.most_bytes);
    job_.steps.timed("contraction", [&] { coarsen_in_bulk(job_); });
  }
  if (!job_.keeping.leaves_all()) job_.input.keep(job_.mesh);
  adapt(job_.keeping.stands ? standing_recipe(job_.r) : recipe(job_.r, fill(job_)));
}

void Run::coarsen(double finer) {
  job_.sizes.use(finer);
  job_.resize();
  ask_all(job_.mesh);
  std::vector<Phase> phases = recipe(job_.r, Seeds::kSome);
  phases.insert(phases.begin(), thinning(job_.r));
  adapt(phases);
}

bool Run::stands() {
  analyse();
  job_.keeping = keep_what_stands(job_, effort_);
  return job_.keeping.stands;
}

bool Run::in_vain() const {
  if (!job_.keeping.possible || job_.keeping.stands) return false;
  MeshSummary before = job_.report.before;
  // A result's surface asks for other sizes than the one that it was made for.
  before.lengths = job_.keeping.own_lengths.value_or(before.lengths);
  return gained_nothing(before, job_.report.after, job_.options);
}

bool Run::mended_in_vain() const {
  return job_.keeping.poor > 0 && mended_by_chance(count_poor(job_.mesh), job_.keeping.poor) &&
         gained_nothing(job_.report.before, job_.report.after, job_.options);
}

/// The ideal surface and the wanted sizes; all tets are to be asked everything.
void Run::analyse() {
  TetMesh& mesh = job_.mesh;
  MeshSummary& before = job_.report.before;
  before.counts = count(mesh);
  // The statistics read places and tets, which nothing of the surface changes.
  run_together([&] { before.quality = quality_statistics(mesh); },
               [&] { job_.surface.take(mesh); });
  ask_all(mesh);
  job_.sizes.look_at(mesh);
  job_.resize();
  const Budget& budget = job_.sizes.budget();
  if (budget.binds()) job_.surface.loosen(mesh, budget.scale());
  mesh.normals.clear();
  before.lengths = length_statistics(mesh);
}

/// A mesh of which much is new. Who forbids new vertices may rely on the order of the old ones.
bool Run::is_to_be_ordered() const {
  return !job_.keeping.stands && !job_.r.freeze.insert && job_.mesh.tets.size() >= kNearAnyway;
}

/// All that comes after the mesh is about as fine as wanted.
void Run::adapt(const std::vector<Phase>& phases) {
  for (const Phase& phase : phases) {
    forget_interfaces(job_.mesh);
    job_.steps.timed(phase.name, [&] { run_phase(job_, phase); });
  }
  if (is_to_be_ordered())
    job_.steps.timed("ordering", [&] { sort_along_curve(job_.mesh, &job_.report.part_of_tet); });
  job_.steps.timed("residual", [&] { run_residual_of(job_, phases.back()); });
  mend_poor(job_);
  const SurfaceDistance distance = measure_and_repair(job_);
  job_.steps.timed("statistics", [&] { conclude(job_, distance); });
  job_.report.peak_resident_bytes = peak_resident_bytes();
}

}  // namespace cavea
