#pragma once
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Removes the holes that removed vertices, tets and triangles have left, as compact() does, but by
/// putting the last ones into them: where holes are few this costs little more than finding them.
/// \param of_tet if not null, an array with an entry a tet, which is kept in step
/// \pre not a part: no cuts; pinched vertices are tagged
void fill_holes(TetMesh& mesh, std::vector<std::int32_t>* of_tet = nullptr);

}  // namespace cavea
