#pragma once
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// A copy that many threads make: most of the time goes into memory that is touched first.
TetMesh copy_of(const TetMesh& mesh);

}  // namespace cavea
