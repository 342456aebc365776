#pragma once
#include "cavea/cavity/cavity.h"

namespace cavea {

/// Whether around each vertex of the surface the new tets hang together by faces in as many pieces
/// as the removed ones. A surface that passes through itself may have cavities that lie over
/// themselves; what fills these, though all volumes are positive, may part the ball of a vertex
/// into pieces that only the vertex joins, of which those who go around it would see one. \pre none
/// of these vertices is removed
bool keeps_balls(const TetMesh& mesh, const Cavity& cavity);

}  // namespace cavea
