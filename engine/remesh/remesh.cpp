#include "cavea/remesh/remesh.h"

#include <utility>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/base/timer.h"
#include "cavea/remesh/input.h"
#include "cavea/remesh/trials.h"

namespace cavea {

Report remesh(TetMesh& mesh, const SizeField& field, const Options& options) {
  validate(options);
  if (options.optim && field) throw OptionError("optim excludes a field of sizes");
  const int threads = options.threads > 0 ? options.threads : default_threads();
  const Timer timer;
  Report report;
  run_in_arena(threads, [&] {
    // A field of the caller, or the surface that he names, may look at the mesh.
    Input input(mesh, !field && !options.surface);
    Result result = run_trials(input, field, options);
    report = std::move(result.report);
    mesh = std::move(result.mesh);
  });
  report.threads = threads;
  report.seconds = timer.seconds();
  report.tets_per_second = double(report.after.counts.tets) / report.seconds;
  return report;
}

}  // namespace cavea
