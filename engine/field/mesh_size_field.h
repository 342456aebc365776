#pragma once
#include <array>
#include <vector>

#include "cavea/geometry/box_tree.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Sizes given at the vertices of a mesh, as a function of a point: linear within a tet, and
/// outside of the mesh those of its nearest place. Linear, not in the logarithm, because lengths
/// (metric_length) and the gradation take sizes as linear along an edge: so both say the same of
/// the map and of the mesh.
///
/// A snapshot: it holds no reference to the mesh, so that a map is not blurred by a mesh that
/// changes under it. Read-only after construction: many threads may ask at once, and the answer
/// depends on the mesh and the point alone.
class MeshSizeField {
 public:
  /// Takes the living tets of `mesh` with the sizes at their vertices. \pre mesh.sizes are positive
  explicit MeshSizeField(const TetMesh& mesh);

  /// The size at p, in the mesh's unit; between the smallest and the largest given.
  double operator()(const Vec3& p) const;

 private:
  using Corners = std::array<Vec3, 4>;

  Corners corners(std::size_t slot) const;
  double weigh(std::size_t slot, const std::array<double, 4>& weights) const;
  bool find_inside(const Vec3& p, double& size) const;
  double at_nearest(const Vec3& p) const;

  std::vector<Vec3> points_;
  std::vector<float> sizes_;
  std::vector<std::array<VertexId, 4>> tets_;  ///< in the order of the tree's slots
  BoxTree tree_;
};

}  // namespace cavea
