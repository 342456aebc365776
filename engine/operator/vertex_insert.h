#pragma once
#include "cavea/geometry/box.h"
#include "cavea/operator/delaunay_cavity.h"

namespace cavea {

/// Inserts vertices into the volume by the Delaunay kernel: the cavity grows from the tet around
/// the vertex. It takes the place of vertices that are too near and tagged as replaceable: then the
/// cavity has all of their tets.
///
/// Reads and takes only tets all of whose vertices are in a box, the reach, and reads those next to
/// them: insertions in disjoint reaches may run at the same time on one mesh.
class VertexInsert {
 public:
  /// A vertex nearer to another one than this, in wanted sizes, would only be collapsed.
  static constexpr double kNearest = 0.7;

  VertexInsert(const TetMesh& mesh, const Box& reach);

  /// Whether a vertex within reach has been replaced.
  bool is_gone(VertexId v) const { return in_reach(v) && mesh_.vertex_tets[v] == kNone; }

  /// The tet around p, walking from one at vertex `from`; kNone if something is in the way or the
  /// walk leaves the reach.
  TetId locate(VertexId from, const Vec3& p) const;

  /// \param start a tet around the vertex. Verdicts: kFrozen where the reach ends, kBadLength near
  /// another vertex or the surface.
  Verdict operator()(const NewVertex& vertex, VertexId id, TetId start, Cavity& cavity);

 private:
  /// \param fresh the only vertex of it that is not of a tet taken before; 4: all are
  Verdict may_take(const NewVertex& vertex, TetId t, int fresh);
  Verdict add_ball(VertexId v);
  bool may_be_beside(const NewVertex& vertex, VertexId v);
  Verdict grow(const NewVertex& vertex, TetId start);
  bool in_reach(VertexId v) const { return reach_.contains(mesh_.points[v]); }
  bool near_surface(const NewVertex& vertex, TetId t) const;

  const TetMesh& mesh_;
  const Box reach_;
  DelaunayCavity hole_;
  std::vector<TetId> first_;  ///< that the cavity must have
  std::vector<TetId> ball_;
  IdMap is_first_;
  std::vector<VertexId> replaced_;  ///< whose tets are among these, or are to be
};

}  // namespace cavea
