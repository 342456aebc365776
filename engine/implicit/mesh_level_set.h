#pragma once
#include <span>

#include "cavea/geometry/box.h"
#include "cavea/implicit/cut.h"
#include "cavea/implicit/level_set.h"
#include "cavea/implicit/refine.h"

namespace cavea {

/// From a function to a mesh that remesh() can begin with: a box, fine near the level set, and cut
/// along it. \param zeros of it, one or more on each piece that is to be found; empty: they are
/// looked for on a lattice of 64 cells along the box's longest side
/// \throw InputError, OptionError as cut_along(); OptionError as box_mesh()
CutResult mesh_level_set(const Box& box, const LevelSet& level_set,
                         std::span<const OrientedPoint> zeros, const RefineOptions& refine,
                         const CutOptions& cut = {});

}  // namespace cavea
