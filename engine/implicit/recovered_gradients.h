#pragma once
#include <span>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// What values at vertices tell beyond their linear interpolation: gradients at the vertices, and
/// from them zeros on edges that are exact for a quadratic function where the mesh is regular.
/// Linear zeros are off by an eighth of the curvature times the edge's length squared, with a sign
/// and size that differ from edge to edge: roughness that a smooth surface should not inherit.
class RecoveredGradients {
 public:
  /// \param values one a vertex of `mesh`; both must outlive this
  RecoveredGradients(const TetMesh& mesh, std::span<const double> values);

  /// The mean of the linear function's gradients over the tets at the vertex, by volume.
  const Vec3& at(VertexId v) const { return gradients_[v]; }

  /// Where the function is zero on an edge whose ends have values of different signs, as a share in
  /// [0, 1] of the way from a to b: that of the linear function where the gradients at the ends do
  /// not agree on how the edge is curved, as at kinks.
  double zero_on_edge(VertexId a, VertexId b) const;

 private:
  const TetMesh& mesh_;
  std::span<const double> values_;
  std::vector<Vec3> gradients_;
};

}  // namespace cavea
