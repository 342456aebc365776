#pragma once
#include <span>
#include <vector>

#include "cavea/implicit/interface_vertices.h"
#include "cavea/implicit/level_set.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// What else is to be heeded.
struct ClearScope {
  std::vector<char> fixed = {};  ///< by vertex, whether it is not to be moved; empty: none
  std::vector<char> split = {};  ///< by tet, whether it is to be cut at all; empty: all
  /// The mesh is cut along these: vertices on them move only to where both they and the level set
  /// are zero.
  std::span<const MeshedLevelSet> earlier = {};
};

/// Makes room for a cut: vertices that the level set passes near to are moved onto it, where the
/// tets at them allow it and the cut's triangles stay within the tolerance of the level set, and
/// those that would pinch the interface there are moved away. So the cut makes hardly any slivers.
/// Vertices on the boundary stay on it.
/// \param level_set with a gradient \pre mesh has no holes
void clear_for_cut(TetMesh& mesh, const LevelSet& level_set, double tolerance,
                   const ClearScope& scope = {});

}  // namespace cavea
