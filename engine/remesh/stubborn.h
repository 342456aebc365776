#pragma once
#include <vector>

#include "cavea/pass/cycle.h"
#include "cavea/remesh/report.h"

namespace cavea {

/// What is not zero in a table.
std::vector<VerdictCount> counts_of(const VerdictTable& table);

/// The worst tets below a quality, at most 20, the worst first; each with what every operator says
/// that is asked once more with the settings of the last phase, and with what about the domain
/// forbids better, if that is known. \pre no holes
std::vector<StubbornTet> find_stubborn(const TetMesh& mesh, const SurfaceModel& surface,
                                       const CycleSettings& settings, double below);

}  // namespace cavea
