#include "cavea/implicit/interface_vertices.h"

#include <algorithm>
#include <utility>

namespace cavea {

std::vector<InterfaceVertex> interface_vertices(const TetMesh& mesh,
                                                std::span<const MeshedLevelSet> level_sets) {
  std::vector<std::pair<VertexId, std::size_t>> pairs;
  for (const Triangle& s : mesh.triangles)
    for (std::size_t k = 0; k < level_sets.size() && s.alive(); ++k)
      if (s.ref == level_sets[k].interface_ref)
        for (const VertexId v : s.v) pairs.emplace_back(v, k);
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  std::vector<InterfaceVertex> vertices;
  for (const auto& [v, k] : pairs) {
    if (vertices.empty() || vertices.back().id != v) vertices.push_back({v, {}});
    vertices.back().level_sets.push_back(k);
  }
  return vertices;
}

}  // namespace cavea
