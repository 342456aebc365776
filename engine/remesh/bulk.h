#pragma once
#include <functional>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// Pattern subdivision, all at once and level by level, of the surface edges that are much longer
/// than wanted (paper, section 4.1.1), until few are left; `resize` sets the wanted sizes of a
/// finer mesh. The volume is left to seed_interior(). \return the number of levels
int refine_in_bulk(TetMesh& mesh, const SurfaceModel& surface, const std::function<void()>& resize);

}  // namespace cavea
