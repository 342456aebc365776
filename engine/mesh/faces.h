#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "cavea/base/buckets.h"
#include "cavea/geometry/predicates.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The vertices of face f of a tet, counter-clockwise from outside.
inline std::array<VertexId, 3> face_vertices(const std::array<VertexId, 4>& tet, int f) {
  const auto& k = kFaceVertices[f];
  return {tet[k[0]], tet[k[1]], tet[k[2]]};
}

inline std::array<VertexId, 3> sorted(std::array<VertexId, 3> v) {
  if (v[0] > v[1]) std::swap(v[0], v[1]);
  if (v[1] > v[2]) std::swap(v[1], v[2]);
  if (v[0] > v[1]) std::swap(v[0], v[1]);
  return v;
}

/// Whether an odd permutation sorts v. Two tets on either side of a face see it in opposite order:
/// one is odd and the other is not.
inline bool is_odd(const std::array<VertexId, 3>& v) {
  return ((v[0] > v[1]) ^ (v[1] > v[2]) ^ (v[0] > v[2])) != 0;
}

/// Whether tet t has no volume.
inline bool is_flat(const TetMesh& mesh, TetId t) {
  const auto [a, b, c, d] = mesh.corners(t);
  return orientation(a, b, c, d) == 0;
}

/// Whether face f of tet t is surface whatever the lists say: it has no neighbour, or one of
/// another reference. \pre no triangle is attached to it
inline bool is_surface_face(const TetMesh& mesh, TetId t, int f) {
  const FaceLink link = mesh.links[t][f];
  return link.is_unset() || (link.is_tet() && mesh.tet_refs[link.tet()] != mesh.tet_refs[t]);
}

enum class FaceChoice { kSurface, kAll };

/// The faces that surface triangles may cover, to be found by their vertices: those of
/// is_surface_face(), or all, where internal triangles are kept.
class SurfaceFaces {
 public:
  explicit SurfaceFaces(const TetMesh& mesh, FaceChoice choice = FaceChoice::kSurface);

  /// Slots of the faces on the three vertices; (begin, begin) if there is none.
  using Slots = std::pair<std::size_t, std::size_t>;
  Slots find(const TetMesh& mesh, std::array<VertexId, 3> vertices) const;

  /// Calls f(slots) for the faces on each triple of vertices whose smallest is v, in their order.
  template <class F>
  void for_each(const TetMesh& mesh, VertexId v, F&& f) const {
    const std::size_t end = faces_.end_of(v);
    for (std::size_t s = faces_.begin_of(v), e; s < end; s = e) {
      for (e = s + 1; e < end && key(mesh, e) == key(mesh, s);) ++e;
      f(Slots{s, e});
    }
  }

  std::size_t slots() const { return faces_.size(); }
  FaceLink operator[](std::size_t slot) const {
    return FaceLink::from_code(static_cast<std::int32_t>(faces_[slot]));
  }

 private:
  std::array<VertexId, 3> key(const TetMesh& mesh, std::size_t slot) const {
    const FaceLink face = (*this)[slot];
    return sorted(face_vertices(mesh.tets[face.tet()], face.face()));
  }

  Buckets faces_;  ///< face codes by smallest vertex, sorted by vertices, then code
};

/// attach_triangles() with the table already at hand.
void attach_triangles(TetMesh& mesh, const SurfaceFaces& faces);

}  // namespace cavea
