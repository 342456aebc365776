#pragma once
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Turns tets of zero volume so that they and their neighbours see common faces in opposite order:
/// their own geometry does not say how they stand, and a cavity with one of them needs it.
/// \pre tets are linked by link_faces() alone.
/// \throw InputError a flat tet whose neighbours contradict each other: two of them overlap
void orient_flat_tets(TetMesh& mesh);

}  // namespace cavea
