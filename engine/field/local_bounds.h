#pragma once
#include <span>
#include <vector>

#include "cavea/field/local_parameters.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Bounds of the wanted size at each vertex.
struct VertexBounds {
  std::vector<float> hmin, hmax;
};

/// The bounds at the vertices: those of the references that a vertex touches, the smallest of each
/// kind where several set one, and hmin and hmax where none does. hmin gives way to hmax. \pre no
/// holes
VertexBounds bounds_of_vertices(const TetMesh& mesh, double hmin, double hmax,
                                std::span<const LocalParameters> local);

}  // namespace cavea
