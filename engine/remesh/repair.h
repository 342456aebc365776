#pragma once
#include "cavea/remesh/job.h"
#include "cavea/surface/distance.h"

namespace cavea {

/// The smallest size of repairs. The least of all bounds is a wish, but what bounds a uniform size
/// from below would forbid them.
double finest_size(const ResolvedOptions& r);

/// Measures how far the mesh and the ideal surface are from each other, after the caller's last
/// touch, and makes the surface finer where that is too much: what the curvature did not tell.
/// \return the distance at the end
SurfaceDistance measure_and_repair(Job& job);

}  // namespace cavea
