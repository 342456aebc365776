#pragma once
#include <functional>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

struct BulkOptions {
  bool surface_only = false;
  bool surface_frozen = false;  ///< edges of the surface are not halved
};

/// Pattern subdivision, all at once and level by level, of the edges that are much longer than
/// wanted (paper, section 4.1.1), until few are left; `resize` sets the wanted sizes of a finer
/// mesh. \return the number of levels
int refine_in_bulk(TetMesh& mesh, const SurfaceModel& surface, const BulkOptions& options,
                   const std::function<void()>& resize);

}  // namespace cavea
