#pragma once
#include <algorithm>
#include <cstdint>
#include <span>

#include "cavea/base/buckets.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The edge of a surface triangle opposite its vertex `local`.
struct TriangleEdge {
  TriangleId triangle = kNone;
  int local = 0;
};

/// The edges of the living surface triangles, each with all its triangles. A snapshot: it holds no
/// reference to the mesh, and is out of date once a triangle's vertices change.
class SurfaceEdges {
 public:
  using Uses = std::span<const std::uint32_t>;

  explicit SurfaceEdges(const TetMesh& mesh)
      : uses_(mesh.triangles.size(), mesh.points.size(), [&](std::size_t i, auto&& put) {
          const auto& v = mesh.triangles[i].v;
          if (!mesh.triangles[i].alive()) return;
          for (int k = 0; k < 3; ++k)
            put(std::min(v[(k + 1) % 3], v[(k + 2) % 3]), static_cast<std::uint32_t>(3 * i + k));
        }) {
    parallel_for(uses_.keys(), [&](std::size_t v) {
      const auto uses = uses_.of(v);
      std::sort(uses.begin(), uses.end(), [&](std::uint32_t a, std::uint32_t b) {
        const VertexId pa = far_end(mesh, a), pb = far_end(mesh, b);
        return pa != pb ? pa < pb : a < b;
      });
    });
  }

  static TriangleEdge decode(std::uint32_t use) {
    return {static_cast<TriangleId>(use / 3), static_cast<int>(use % 3)};
  }
  /// The larger vertex of the edge of a use.
  static VertexId far_end(const TetMesh& mesh, std::uint32_t use) {
    const auto [triangle, k] = decode(use);
    const auto& v = mesh.triangles[triangle].v;
    return std::max(v[(k + 1) % 3], v[(k + 2) % 3]);
  }

  std::size_t vertices() const { return uses_.keys(); }

  /// Calls f(b, uses) for each edge (a, b) with a < b, by increasing b; uses by triangle.
  template <class F>
  void for_each_at(const TetMesh& mesh, VertexId a, F&& f) const {
    const Uses uses = uses_.of(a);
    for (std::size_t i = 0, j; i < uses.size(); i = j) {
      const VertexId b = far_end(mesh, uses[i]);
      for (j = i + 1; j < uses.size() && far_end(mesh, uses[j]) == b;) ++j;
      f(b, uses.subspan(i, j - i));
    }
  }

  /// The uses of edge (a, b); empty if no triangle has it.
  Uses find(const TetMesh& mesh, VertexId a, VertexId b) const {
    if (a > b) std::swap(a, b);
    const Uses uses = uses_.of(a);
    const auto first = std::lower_bound(
        uses.begin(), uses.end(), b,
        [&](std::uint32_t use, VertexId wanted) { return far_end(mesh, use) < wanted; });
    auto last = first;
    while (last != uses.end() && far_end(mesh, *last) == b) ++last;
    return Uses(first, last);
  }

 private:
  Buckets uses_;  ///< 3 * triangle + local, by the edge's smaller vertex; sorted by the larger
};

}  // namespace cavea
