#pragma once
#include "cavea/remesh/job.h"
#include "cavea/remesh/recipe.h"

namespace cavea {

/// Takes away most vertices inside where there are far too many.
void coarsen_in_bulk(Job& job);

/// Brings the mesh near the wanted sizes by what needs no search for where to put vertices: long
/// edges of the surface are halved, what is too fine is collapsed, and the volume is filled with
/// seeds. \return how many seeds
Seeds fill(Job& job);

}  // namespace cavea
