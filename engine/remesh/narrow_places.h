#pragma once
#include <functional>

#include "cavea/remesh/job.h"
#include "cavea/surface/distance.h"

namespace cavea {

/// Where few tets are not sound (then: hardly any is poor), since the domain or what lies between
/// its features is narrower than the wanted sizes know, or only by chance: halves the sizes around
/// them and mends what then is too long, up to five times; where half is no help, but not for the
/// angles of the domain, less is tried at once. Each time all is taken back at the tets that this
/// does not make fewer, or the worst of them clearly better, and everywhere where the surface would
/// be farther from the ideal one than it may be or was, pass through itself, or the worst tet be
/// worse. Uniform sizes give way there, too, down to ResolvedOptions::finest, as in repairs. What
/// is not sound first, and what is left then, is led out by detours (see Detour), one tet after the
/// other. \param distance of the mesh from the ideal surface, kept in step by measure(), which may
/// repair
void refine_narrow_places(Job& job, SurfaceDistance& distance,
                          const std::function<SurfaceDistance()>& measure);

}  // namespace cavea
