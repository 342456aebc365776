#pragma once
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Two triangles of the exterior boundary that pass through each other.
struct Crossing {
  TriangleId a, b;
  Vec3 where;  ///< middle of an edge of one that passes through the other
};

/// All pairs of triangles of the exterior boundary of which an edge of one passes through the
/// inside of the other, with a < b, sorted. Tets of positive volume cannot overlap but across the
/// boundary, so without crossings the mesh is embedded. Triangles that only touch do not count.
/// What rounding leaves open counts as touching, too.
/// The same at any number of threads.
std::vector<Crossing> find_crossings(const TetMesh& mesh);

}  // namespace cavea
