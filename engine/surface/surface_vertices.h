#pragma once
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The vertices of the living surface triangles, numbered as these name them first: they are few of
/// all.
struct SurfaceVertices {
  explicit SurfaceVertices(const TetMesh& m) : number(m.points.size(), kNone) {
    for (const Triangle& t : m.triangles) {
      if (!t.alive()) continue;
      for (const VertexId v : t.v) {
        if (number[v] != kNone) continue;
        number[v] = std::int32_t(vertices.size());
        vertices.push_back(v);
      }
    }
  }
  std::vector<VertexId> vertices;
  std::vector<std::int32_t> number;  ///< of each vertex of the mesh; none off the surface
};

}  // namespace cavea
