#pragma once
#include <algorithm>
#include <array>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The face on the three vertices among the tets [begin, end); unset if there is none.
inline FaceLink find_face(const TetMesh& mesh, TetId begin, TetId end,
                          const std::array<VertexId, 3>& face) {
  for (TetId t = begin; t < end; ++t) {
    int opposite = 0, shared = 0;
    for (int i = 0; i < 4; ++i) {
      const VertexId v = mesh.tets[t][i];
      if (v == face[0] || v == face[1] || v == face[2])
        ++shared;
      else
        opposite = i;
    }
    if (shared == 3) return FaceLink::to_tet(t, opposite);
  }
  return {};
}

/// The triangle on the three vertices among [begin, end); kNone if there is none.
inline TriangleId find_triangle(const TetMesh& mesh, TriangleId begin, TriangleId end,
                                const std::array<VertexId, 3>& face) {
  for (TriangleId s = begin; s < end; ++s)
    if (std::is_permutation(face.begin(), face.end(), mesh.triangles[s].v.begin())) return s;
  return kNone;
}

}  // namespace cavea
