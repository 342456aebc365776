#pragma once
#include "cavea/mesh/new_vertex.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// The vertex in the middle of an edge (paper, section 4.1.1): the straight midpoint inside the
/// volume; for a surface edge, opposite local vertex `side` of surface triangle `triangle`, the
/// place on the ideal surface or, for a feature edge, on its curve. `triangle` is kNone for an
/// interior edge.
NewVertex midpoint(const TetMesh& mesh, const SurfaceModel& surface, VertexId a, VertexId b,
                   TriangleId triangle, int side);

}  // namespace cavea
