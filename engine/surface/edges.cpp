#include "cavea/surface/edges.h"

#include <tuple>

#include "cavea/base/parallel.h"

namespace cavea {

std::vector<EdgeSide> sorted_edge_sides(const std::vector<Triangle>& triangles) {
  std::vector<EdgeSide> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (!triangles[t].alive()) continue;
    for (int k = 0; k < 3; ++k) {
      const VertexId a = triangles[t].v[(k + 1) % 3], b = triangles[t].v[(k + 2) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), static_cast<TriangleId>(t), k});
    }
  }
  parallel_sort(sides.begin(), sides.end(), [](const EdgeSide& x, const EdgeSide& y) {
    return std::tie(x.a, x.b, x.triangle, x.k) < std::tie(y.a, y.b, y.triangle, y.k);
  });
  return sides;
}

}  // namespace cavea
