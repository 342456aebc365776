#pragma once
#include <cstdint>

#include "cavea/cavity/verdict.h"
#include "cavea/remesh/ideal_surface.h"
#include "cavea/remesh/input.h"
#include "cavea/remesh/keeping.h"
#include "cavea/remesh/options.h"
#include "cavea/remesh/report.h"
#include "cavea/remesh/resolved.h"
#include "cavea/remesh/sizing.h"
#include "cavea/remesh/steps.h"

namespace cavea {

/// What the steps of a run share: the mesh, what it is to become, and what is told about it.
struct Job {
  /// \param finer the share that is used of sizes that are not given
  Job(Input& input, const SizeField& field, const Options& options, double finer);

  void resize() { sizes.set(mesh, surface); }

  Input& input;  ///< whole before the structure of the mesh changes: see Input::keep()
  Loan loan;
  TetMesh& mesh;

  const Options& options;
  Report report;
  VerdictTable verdicts;
  Steps steps;

  const SizeField field;  ///< the caller's, or the mesh's own sizes if these are asked for
  const ResolvedOptions r;
  const std::int64_t most_bytes;
  IdealSurface surface;
  Sizing sizes;
  Keeping keeping;  ///< known after the analysis
};

}  // namespace cavea
