#pragma once
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Whether removed vertices, tets or triangles have left holes.
bool has_holes(const TetMesh& mesh);

/// Removes the holes that removed vertices, tets and triangles have left; the others keep their
/// order. Numbers of cuts stay as they are.
void compact(TetMesh& mesh);

}  // namespace cavea
