#pragma once
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "cavea/implicit/level_set.h"
#include "cavea/mesh/local.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// How much worse the tets at a vertex may become when it moves.
struct MoveLimits {
  double share = 0;  ///< of their worst quality that is kept, or
  double floor = 0;  ///< the quality that is enough
};

/// Moves vertices of a mesh one after the other, where the tets at them allow it.
class VertexMoves {
 public:
  /// \param free_refs triangles of these references are no boundary to stay on
  explicit VertexMoves(TetMesh& mesh, std::vector<std::int32_t> free_refs = {})
      : mesh_(mesh), free_refs_(std::move(free_refs)) {}

  /// What of a step keeps a vertex on the exterior boundary, if it is in one plane or on a line in
  /// which two planes meet: all of it inside, none at corners and where the boundary is curved.
  Vec3 along_boundary(VertexId v, const Vec3& step);

  /// The way of a vertex to the level sets, see way_to_zero(), along the boundary if it is on it.
  Vec3 to_zero(VertexId v, std::span<const LevelSet* const> level_sets, double reach);

  /// What else is asked of the tets at a vertex that has moved.
  using Accepts = std::function<bool(std::span<const TetId>)>;

  /// Moves a vertex by a step, or a half or a quarter of it. \returns whether it moved
  bool move(VertexId v, const Vec3& step, const MoveLimits& limits, const Accepts& accepts = {});

  double shortest_edge(VertexId v);

 private:
  void gather(VertexId v);
  bool is_boundary(const Triangle& s) const;
  bool allows(const Vec3& place, const MoveLimits& limits);

  TetMesh& mesh_;
  const std::vector<std::int32_t> free_refs_;
  TetMarker marker_;
  Ball ball_;
  std::vector<float> qualities_;  ///< of the ball's tets, were the vertex at the place asked for
};

}  // namespace cavea
