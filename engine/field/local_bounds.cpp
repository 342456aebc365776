#include "cavea/field/local_bounds.h"

#include <algorithm>
#include <limits>

#include "cavea/base/atomic.h"
#include "cavea/base/parallel.h"

namespace cavea {
namespace {

constexpr float kUnset = std::numeric_limits<float>::infinity();

/// Lowers the bounds of the vertices in `rows` by what is asked of the references beside them.
template <class Row, class Reference>
void lower(VertexBounds& bounds, std::size_t n, LocalParameters::Entity entity,
           std::span<const LocalParameters> local, Row&& row, Reference&& reference) {
  for (const LocalParameters& p : local) {
    if (p.entity != entity || (!p.hmin && !p.hmax)) continue;
    parallel_for(n, [&](std::size_t i) {
      if (reference(i) != p.reference) return;
      for (const VertexId v : row(i)) {
        if (p.hmin) atomic_min(bounds.hmin[v], float(*p.hmin));
        if (p.hmax) atomic_min(bounds.hmax[v], float(*p.hmax));
      }
    });
  }
}

}  // namespace

VertexBounds bounds_of_vertices(const TetMesh& mesh, double hmin, double hmax,
                                std::span<const LocalParameters> local) {
  const std::size_t n = mesh.points.size();
  VertexBounds bounds{std::vector<float>(n, kUnset), std::vector<float>(n, kUnset)};
  using Entity = LocalParameters::Entity;
  const auto triangle = [&](std::size_t i) -> auto& { return mesh.triangles[i]; };
  lower(
      bounds, mesh.triangles.size(), Entity::kTriangles, local,
      [&](std::size_t i) { return triangle(i).v; }, [&](std::size_t i) { return triangle(i).ref; });
  lower(
      bounds, mesh.tets.size(), Entity::kTets, local, [&](std::size_t i) { return mesh.tets[i]; },
      [&](std::size_t i) { return mesh.tet_refs[i]; });
  parallel_for(n, [&](std::size_t v) {
    if (bounds.hmax[v] == kUnset) bounds.hmax[v] = float(hmax);
    if (bounds.hmin[v] == kUnset) bounds.hmin[v] = float(hmin);
    bounds.hmin[v] = std::min(bounds.hmin[v], bounds.hmax[v]);
  });
  return bounds;
}

}  // namespace cavea
