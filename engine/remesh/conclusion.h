#pragma once
#include "cavea/remesh/job.h"
#include "cavea/surface/distance.h"

namespace cavea {

/// Fills in the report what the result is: its statistics, how far it is from the ideal surface,
/// what stays bad and why, and whether the targets are met.
void conclude(Job& job, const SurfaceDistance& distance);

}  // namespace cavea
