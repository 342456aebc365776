#pragma once
#include <cstdint>
#include <span>

#include "cavea/implicit/interface_vertices.h"
#include "cavea/implicit/level_set.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Moves the vertices of the triangles of one reference onto the level set, by Newton steps, or a
/// part of the way where the tets at them would become worse than a finished mesh's are to be.
/// Those on planes of the boundary stay in them; corners and required vertices stay.
/// None moves by more than a quarter of its shortest edge: it is no part of the level set.
/// \param level_set with a gradient
void project_onto(TetMesh& mesh, const LevelSet& level_set, std::int32_t interface_ref);

/// The same for several level sets, of a reference each. Where two of them meet, vertices go to the
/// curve that they have in common; where three do, to the point, although it is a corner.
void project_onto(TetMesh& mesh, std::span<const MeshedLevelSet> level_sets);

/// How far the level set is from the triangles of one reference at vertices, edges' middles and
/// centroids: the largest, but no more than a triangle's longest edge. Looked for along the
/// triangle's normal and the function's slope, of which the shorter way is an upper bound.
/// \param level_set with a gradient
double distance_from(const TetMesh& mesh, const LevelSet& level_set, std::int32_t interface_ref);

}  // namespace cavea
