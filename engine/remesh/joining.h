#pragma once
#include <functional>

#include "cavea/remesh/job.h"
#include "cavea/surface/distance.h"

namespace cavea {

/// The very last resort for tets that are not sound: where parts of the surface are nearer to each
/// other than the tolerance and leave no room for good tets, they are joined (surface_merge()) as
/// far as that makes these better, and what is around is mended. All is taken back where the
/// surface would then be farther from the ideal one than it may be or was, pass through itself, or
/// the worst tet be no better. Nothing moves that is required or a given corner or ridge, no curve
/// by more than the tolerance in any of five rounds, and no reference is lost.
/// \param distance of the mesh from the ideal surface, kept in step by measure()
void join_surface(Job& job, SurfaceDistance& distance,
                  const std::function<SurfaceDistance()>& measure);

}  // namespace cavea
