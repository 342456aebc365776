#pragma once
#include <optional>
#include <span>
#include <vector>

#include "cavea/cavity/cavity.h"

namespace cavea {

/// Tets of a mesh that make room for the star of a point: its tets stand on the faces of their hull
/// but for the surface triangles that go with them.
class StarredHole {
 public:
  /// \param gone sorted
  StarredHole(const TetMesh& mesh, std::vector<TetId> tets, std::span<const TriangleId> gone,
              const Vec3& place);

  /// Whether no surface triangle that stays is inside, and none goes that bounds what stays.
  bool is_whole() const { return is_whole_; }
  const std::vector<TetId>& tets() const { return tets_; }  ///< sorted
  /// The tets of the star with vertex `apex` at the point.
  std::vector<NewTet> star(VertexId apex) const;
  /// The vertices that none of the hull's faces has; none where the hull is no sphere.
  std::optional<std::vector<VertexId>> vertices_inside() const;

 private:
  struct Face {
    TetId tet = kNone;
    int face = 0;
  };

  void find_hull();
  bool goes(FaceLink link) const;
  void add_edges(TetId t, int face);

  const TetMesh& mesh_;
  std::vector<TetId> tets_;
  std::span<const TriangleId> gone_;
  Vec3 place_;
  bool is_whole_ = true;
  std::vector<Face> faces_;
  std::vector<std::array<VertexId, 2>> edges_;  ///< of the whole hull, once from each side
};

}  // namespace cavea
