#pragma once
#include <vector>

#include "cavea/part/extract.h"
#include "cavea/pass/cycle.h"

namespace cavea {

/// Runs the cycle on each part, as tasks, and sums what they did. \throw Cancelled
CycleResult run_parts(std::vector<Part>& parts, const SurfaceModel& surface,
                      const CycleSettings& settings);

}  // namespace cavea
