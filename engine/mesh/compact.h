#pragma once
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Removes the holes that removed vertices, tets and triangles have left; the others keep their
/// order. Numbers of cuts stay as they are.
void compact(TetMesh& mesh);

}  // namespace cavea
