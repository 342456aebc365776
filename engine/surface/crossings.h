#pragma once
#include <array>
#include <span>
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

/// A surface triangle that may be none of the mesh yet.
struct PlacedTriangle {
  std::array<VertexId, 3> v{kNone, kNone, kNone};
  std::array<Vec3, 3> corners;
};

/// Whether one of some triangles would pass through another of them, or through one of the exterior
/// boundary but for those that they replace. Looks at all triangles of the mesh.
bool would_cross(const TetMesh& mesh, std::span<const PlacedTriangle> triangles,
                 std::span<const TriangleId> replaced);

}  // namespace cavea
