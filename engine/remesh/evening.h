#pragma once
#include <atomic>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Evens out the lengths inside the volume: a few times, and for all at once, vertices that nothing
/// binds move as springs along their edges would pull and push them, whose lengths at rest are the
/// wanted sizes (as in Persson and Strang 2004, "A Simple Mesh Generator in MATLAB"). What makes a
/// tet worse than it was, and not sound, is taken back, half of the way or whole. Sizes stay those
/// at the vertices, and the tets are the same ones with other qualities.
/// \pre no holes, sizes are set \throw Cancelled, and the mesh is as it was
void even_out(TetMesh& mesh, const std::atomic<bool>* cancel);

}  // namespace cavea
