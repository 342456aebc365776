#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cavea/implicit/level_set.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// A level set, with a gradient, and the reference of the triangles that stand for it.
struct MeshedLevelSet {
  LevelSet level_set;
  std::int32_t interface_ref = 10;
};

/// A vertex and, by their places, the level sets that it is to be on, rising.
struct InterfaceVertex {
  VertexId id;
  std::vector<std::size_t> level_sets;
};

/// The vertices of the level sets' triangles, rising.
std::vector<InterfaceVertex> interface_vertices(const TetMesh& mesh,
                                                std::span<const MeshedLevelSet> level_sets);

}  // namespace cavea
