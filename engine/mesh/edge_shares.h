#pragma once
#include <array>
#include <bit>
#include <cstdint>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Which edges of a tet it answers for, so that whoever goes through the edges of all tets meets
/// each of them once or a few times, without a table. A tet leaves an edge to a tet of lower id
/// behind one of its two faces at the edge; the lowest tet of an edge has none to leave it to.
/// \pre the faces are linked
class EdgeShare {
 public:
  EdgeShare(const TetMesh& mesh, TetId t) {
    unsigned lower = 0;  // a bit for each face
    for (int f = 0; f < 4; ++f) {
      const FaceLink behind = mesh.links[t][f];
      lower |= unsigned(behind.is_tet() && behind.tet() < t) << f;
    }
    edges_ = kLeft[lower];
  }
  /// Calls f(edge) for its edges, rows of kEdgeVertices. Which these are is hard to guess: no
  /// branch asks for each of the six.
  template <class F>
  void for_each(F&& f) const {
    for (unsigned left = edges_; left != 0; left &= left - 1)
      f(kEdgeVertices[std::countr_zero(left)]);
  }

 private:
  /// For each set of faces the edges that are at none of them.
  static constexpr std::array<std::uint8_t, 16> kLeft = [] {
    std::array<std::uint8_t, 16> left{};
    for (unsigned faces = 0; faces < left.size(); ++faces)
      for (unsigned e = 0; e < 6; ++e) {
        const unsigned at_edge = 1u << kEdgeVertices[e][2] | 1u << kEdgeVertices[e][3];
        if ((faces & at_edge) == 0) left[faces] = std::uint8_t(left[faces] | 1u << e);
      }
    return left;
  }();
  unsigned edges_ = 0;
};

}  // namespace cavea
