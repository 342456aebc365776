#include "cavea/implicit/normals.h"

#include "cavea/base/parallel.h"

namespace cavea {

void add_normals(const LevelSet& level_set, const TetMesh& mesh, std::span<const char> on_interface,
                 MeshData& data) {
  std::vector<Vec3> normals(on_interface.size());
  parallel_for(normals.size(), [&](std::size_t v) {
    if (on_interface[v]) normals[v] = normalized(level_set.gradient(mesh.points[v]));
  });
  for (std::size_t v = 0; v < normals.size(); ++v) {
    if (norm2(normals[v]) == 0 || !is_finite(normals[v])) continue;
    data.normal_at_vertices.push_back({std::int32_t(v), std::int32_t(data.normals.size())});
    data.normals.push_back(normals[v]);
  }
}

}  // namespace cavea
