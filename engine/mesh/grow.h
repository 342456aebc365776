#pragma once
#include <cstddef>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Adds holes to a mesh until it has so many tets and vertices, an array a task: new memory is slow
/// to touch. An array that has to be moved gets room for one of `spare_share` of its items more.
void grow(TetMesh& mesh, std::size_t tets, std::size_t vertices, std::size_t spare_share);

}  // namespace cavea
