#pragma once
#include "cavea/geometry/box.h"
#include "cavea/operator/delaunay_cavity.h"

namespace cavea {

/// Inserts vertices into the volume by the Delaunay kernel: the cavity grows from the tet around
/// the vertex.
///
/// Reads and takes only tets all of whose vertices are in a box, the reach, and reads those next to
/// them: insertions in disjoint reaches may run at the same time on one mesh.
class VertexInsert {
 public:
  /// A vertex nearer to another one than this, in wanted sizes, would only be collapsed.
  static constexpr double kNearest = 0.7;

  VertexInsert(const TetMesh& mesh, const Box& reach);

  /// The tet around p, walking from one at vertex `from`; kNone if something is in the way or the
  /// walk leaves the reach.
  TetId locate(VertexId from, const Vec3& p) const;

  /// \param start a tet around the vertex. Verdicts: kFrozen where the reach ends, kBadLength near
  /// another vertex or the surface.
  Verdict operator()(const NewVertex& vertex, VertexId id, TetId start, Cavity& cavity);

 private:
  Verdict may_take(TetId t) const;
  bool in_reach(VertexId v) const { return reach_.contains(mesh_.points[v]); }
  bool too_near(const NewVertex& vertex, TetId t) const;

  const TetMesh& mesh_;
  const Box reach_;
  DelaunayCavity hole_;
};

}  // namespace cavea
