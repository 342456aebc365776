#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

struct Peeled {
  std::int64_t tets = 0;
  std::vector<VertexId> vertices;  ///< that went with them, by their numbers before; rising
};

/// Takes flat tets off the exterior boundary if any of them hides a vertex that lies on it.
///
/// The Delaunay tets of points in a plane are like that where the plane's coordinates are rounded:
/// most of the points are a last digit inside the hull, below layers of flat tets, which no
/// operator can mend one by one. What is bounded by all tets that have a volume is the same domain,
/// with these points on its boundary. So clusters of flat tets (below kFlat) that reach the
/// boundary go, each as a whole, and the faces behind become surface, with the reference of what
/// lay above them.
///
/// A cluster stays where that would leave a crack, an edge of more than two triangles or a vertex
/// of `kept` without a tet, and where it has a triangle that is required or between two tets. No
/// holes are left.
/// \pre triangles are attached; edges and vertices have no tags yet
Peeled peel_flat_tets(TetMesh& mesh, std::span<const VertexId> kept);

}  // namespace cavea
