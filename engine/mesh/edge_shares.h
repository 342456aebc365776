#pragma once
#include <array>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Which edges of a tet it answers for, so that whoever goes through the edges of all tets meets
/// each of them once or a few times, without a table. A tet leaves an edge to a tet of lower id
/// behind one of its two faces at the edge; the lowest tet of an edge has none to leave it to.
/// \pre the faces are linked
class EdgeShare {
 public:
  EdgeShare(const TetMesh& mesh, TetId t) {
    for (int f = 0; f < 4; ++f) {
      const FaceLink behind = mesh.links[t][f];
      lower_[f] = behind.is_tet() && behind.tet() < t;
    }
  }
  /// \param edge of kEdgeVertices
  bool has(const int (&edge)[4]) const { return !lower_[edge[2]] && !lower_[edge[3]]; }

 private:
  std::array<bool, 4> lower_;  ///< whether the tet behind each face is
};

}  // namespace cavea
