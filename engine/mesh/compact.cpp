#include "cavea/mesh/compact.h"

#include <functional>

#include "cavea/mesh/renumber.h"

namespace cavea {
bool has_holes(const TetMesh& mesh) {
  const auto dead = [](std::size_t n, auto&& is_alive) {
    return parallel_reduce(
        n, false,
        [&](std::size_t begin, std::size_t end) {
          while (begin < end && is_alive(begin)) ++begin;
          return begin < end;
        },
        std::logical_or<>{});
  };
  return dead(mesh.points.size(), [&](std::size_t v) { return mesh.vertex_alive(VertexId(v)); }) ||
         dead(mesh.tets.size(), [&](std::size_t t) { return mesh.tet_alive(TetId(t)); }) ||
         dead(mesh.triangles.size(), [&](std::size_t i) { return mesh.triangles[i].alive(); });
}

void compact(TetMesh& mesh) {
  if (!has_holes(mesh)) return;
  renumber(mesh, living_vertices(mesh), living_tets(mesh), living_triangles(mesh));
}

}  // namespace cavea
