#pragma once
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// So many layers of tets around those that are asked take part: the first so that their balls are
/// whole, the others so that what changes there can be answered to.
inline constexpr int kLayers = 2;

/// The tets and so many layers of others around them, ascending. \pre no holes in `mesh`
std::vector<TetId> with_layers(const TetMesh& mesh, std::vector<TetId> tets, int layers);

/// The same for few tets: not all of the mesh is looked at, which may have holes.
std::vector<TetId> with_layers_of_few(const TetMesh& mesh, std::vector<TetId> tets, int layers);

/// \param of_tet an array with an entry a tet, which is kept in step
void remove_holes(TetMesh& mesh, std::vector<std::int32_t>& of_tet);

}  // namespace cavea
