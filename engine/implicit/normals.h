#pragma once
#include <span>

#include "cavea/implicit/level_set.h"
#include "cavea/mesh/mesh_data.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Adds the level set's gradient as normals of the vertices on the interface.
/// \param level_set with a gradient \param mesh with the vertices of `data`
void add_normals(const LevelSet& level_set, const TetMesh& mesh, std::span<const char> on_interface,
                 MeshData& data);

}  // namespace cavea
