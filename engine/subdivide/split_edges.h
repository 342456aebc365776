#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "cavea/mesh/surface_edges.h"
#include "cavea/subdivide/subdivide.h"

namespace cavea {

/// The edges that are to be split, by rising (a, b).
class SplitEdges {
 public:
  SplitEdges(const TetMesh& mesh, const SplitTest& split);

  std::size_t size() const { return ends_.size(); }
  const std::array<VertexId, 2>& ends(std::size_t rank) const { return ends_[rank]; }

  /// The rank of edge (a, b); kNone if it is not to be split.
  std::int32_t find(VertexId a, VertexId b) const {
    if (a > b) std::swap(a, b);
    for (std::int32_t k = offsets_[a]; k < offsets_[a + 1]; ++k)
      if (ends_[k][1] >= b) return ends_[k][1] == b ? k : kNone;
    return kNone;
  }

  /// The edge of a rank with its surface triangle.
  MeshEdge edge(const TetMesh& mesh, std::size_t rank) const {
    return with_triangle(mesh, ends_[rank][0], ends_[rank][1]);
  }

 private:
  MeshEdge with_triangle(const TetMesh& mesh, VertexId a, VertexId b) const;

  SurfaceEdges surface_;
  std::vector<std::int32_t> offsets_;  ///< into ends_, of each smaller end
  std::vector<std::array<VertexId, 2>> ends_;
};

}  // namespace cavea
