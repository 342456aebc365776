#pragma once
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/subdivide/split_edges.h"

namespace cavea {

/// A subdivision whose vertices are to be settled.
struct Subdivided {
  const TetMesh& mesh;  ///< before
  const SplitEdges& edges;
  const std::vector<TetId>& first_child;  ///< of each tet of mesh, and one past the last
  VertexId first_new;                     ///< the vertex on the first split edge
  double least_volume_share;              ///< see subdivide()
};

/// Draws new vertices back to their straight edges until every child of a tet that is certainly
/// positive is so too, or all its vertices are there. `out` is the subdivided mesh.
void settle(const Subdivided& from, TetMesh& out);

}  // namespace cavea
