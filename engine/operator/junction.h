#pragma once
#include <cstddef>
#include <vector>

#include "cavea/base/ids.h"
#include "cavea/geometry/vec3.h"

namespace cavea {

/// Side k of a surface triangle: the one opposite corner k.
struct SurfaceSide {
  TriangleId triangle = kNone;
  std::size_t k = 0;
};

/// Where parts of the surface are to meet: a new vertex takes the place of some of its vertices,
/// and cuts some of its feature edges.
struct Junction {
  std::vector<VertexId> vertices;
  std::vector<SurfaceSide> edges;
  Vec3 place;
};

}  // namespace cavea
