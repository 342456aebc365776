#pragma once
#include <vector>

#include "cavea/pass/cycle.h"
#include "cavea/remesh/report.h"

namespace cavea {

/// What is not zero in a table.
std::vector<VerdictCount> counts_of(const VerdictTable& table);

/// Worse tets are all named: where the domain allows, operators end above.
inline constexpr double kSoundQuality = 0.3;

/// The tets that are not sound, or else the 20 worst below the target, the worst first, at most
/// 1000; each with what every operator says that is asked once more with the settings of the last
/// phase, and with what about the domain forbids better, if that is known. \pre no holes
std::vector<StubbornTet> find_stubborn(const TetMesh& mesh, const SurfaceModel& surface,
                                       const CycleSettings& settings, double target);

}  // namespace cavea
