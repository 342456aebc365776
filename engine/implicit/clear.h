#pragma once
#include <span>

#include "cavea/implicit/level_set.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Makes room for a cut: vertices that the level set passes near to are moved onto it, where the
/// tets at them allow it and the cut's triangles stay within the tolerance of the level set, and
/// those that would pinch the interface there are moved away. So the cut makes hardly any slivers.
/// Vertices on the boundary stay on it.
/// \param level_set with a gradient \param fixed by vertex, those that are not to be moved; empty:
/// none \pre mesh has no holes
void clear_for_cut(TetMesh& mesh, const LevelSet& level_set, double tolerance,
                   std::span<const char> fixed = {});

}  // namespace cavea
