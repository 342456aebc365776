#pragma once
#include <cstdint>
#include <vector>

#include "cavea/cavity/cavity.h"
#include "cavea/cavity/verdict.h"
#include "cavea/geometry/box.h"

namespace cavea {

/// A set of ids that is cleared in no time and stays small enough for the L1 cache, whatever the
/// mesh.
class IdSet {
 public:
  /// \param most ids that are ever put in between two clear()
  explicit IdSet(std::size_t most);
  void clear();
  /// False if it was in.
  bool insert(std::int32_t id);
  void erase(std::int32_t id) { slot(id).in = false; }
  bool contains(std::int32_t id) { return slot(id).in; }

 private:
  struct Slot {
    std::uint32_t epoch = 0;
    std::int32_t id = 0;
    bool in = false;
  };
  Slot& slot(std::int32_t id);

  std::vector<Slot> slots_;  ///< open addressing; size a power of two
  std::uint32_t epoch_ = 1;
};

/// Inserts vertices into the volume by the Delaunay kernel (Bowyer 1981, Watson 1981): the cavity
/// is what is reached from the tet around the vertex through tets whose circumsphere contains it,
/// without crossing surface triangles, made smaller until the vertex sees all its faces. So the
/// mesh need not be Delaunay before, and is as far as possible after.
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
  Verdict grow(const NewVertex& vertex, TetId start);
  Verdict shrink(const Vec3& p, TetId start, Cavity& cavity);
  Verdict may_take(TetId t) const;
  bool in_reach(VertexId v) const { return reach_.contains(mesh_.points[v]); }
  bool too_near(const NewVertex& vertex, TetId t) const;
  bool sees(const Vec3& p, TetId t, Cavity& cavity);
  void keep_connected(TetId start);
  bool encloses_vertex(const Cavity& cavity);

  const TetMesh& mesh_;
  const Box reach_;
  std::vector<TetId> tets_, connected_;
  IdSet taken_, marked_;
};

}  // namespace cavea
