#pragma once
#include <array>
#include <tuple>
#include <vector>

#include "cavea/cavity/verdict.h"
#include "cavea/mesh/tet_mesh.h"
#include "cavea/operator/junction.h"

namespace cavea {

/// The surface triangles that go with the vertices and edges of a junction, and those between their
/// rim and a new vertex that come in their place.
class MergedPatch {
 public:
  /// \param triangles sorted
  MergedPatch(const TetMesh& mesh, const Junction& junction, std::vector<TriangleId> triangles);

  /// Whether that breaks no feature and keeps the topology.
  Verdict verdict() const { return verdict_; }
  const std::vector<TriangleId>& triangles() const { return triangles_; }
  /// Of the new vertex. On curves it is a corner, lest it goes farther from where they were, unless
  /// it leaves them there.
  Tag vertex_tags() const;
  /// The triangles around the new vertex. Its edges have the tags of all that came from their other
  /// ends to what it replaces.
  std::vector<Triangle> star(VertexId apex) const;

 private:
  using Ends = std::array<VertexId, 2>;
  /// An edge of a triangle that goes, smaller end first.
  struct Side {
    Ends ends;
    TriangleId triangle;
    std::size_t k;

    std::tuple<VertexId, VertexId, TriangleId> key() const { return {ends[0], ends[1], triangle}; }
  };
  struct Spoke {
    VertexId end = kNone;
    Tag tags = 0;
    std::int32_t ref = 0;
    int features = 0;
  };

  Verdict gather_sides();
  Ends ends_of(const SurfaceSide& side) const;
  bool is_vertex(VertexId v) const;
  bool is_inner(const Side& side, int triangles) const;
  bool add_spokes(const Side& side);
  Spoke& spoke_to(VertexId end);
  Spoke spoke_at(VertexId end) const;
  bool keeps_topology() const;
  int pieces_at(VertexId v) const;
  bool is_along_curve() const;

  const TetMesh& mesh_;
  const Junction& junction_;
  std::vector<TriangleId> triangles_;
  std::vector<Side> rim_;
  std::vector<Ends> inner_;  ///< edges that go, sorted
  std::vector<Spoke> spokes_;
  Verdict verdict_;
};

/// What no part of a junction may have.
inline constexpr Tag kStays = tag::kRequired | tag::kOnRequiredEdge | tag::kGiven;

}  // namespace cavea
