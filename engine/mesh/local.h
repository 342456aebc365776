#pragma once
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Marks that are cleared in no time: an epoch a tet.
class TetMarker {
 public:
  void begin(std::size_t tets) {
    if (epoch_of_.size() < tets) epoch_of_.resize(tets + tets / 2, 0);
    if (++epoch_ == 0) {
      std::fill(epoch_of_.begin(), epoch_of_.end(), 0);
      epoch_ = 1;
    }
  }
  /// Marks t; false if it was marked already.
  bool mark(TetId t) {
    if (epoch_of_[t] == epoch_) return false;
    epoch_of_[t] = epoch_;
    return true;
  }

 private:
  std::vector<std::uint32_t> epoch_of_;
  std::uint32_t epoch_ = 0;
};

/// The tets at a vertex, across interfaces too. In a part, the ball of a frozen vertex is
/// truncated.
struct Ball {
  VertexId v = kNone;
  std::vector<TetId> tets;
  bool cut = false;  ///< a face of it is the interface of the part
};

void gather_ball(const TetMesh& mesh, VertexId v, TetMarker& marker, Ball& ball);

/// The ids alone, without marks as large as the mesh: for few balls of many tets.
void small_ball(const TetMesh& mesh, VertexId v, std::vector<TetId>& ball);

/// Calls f(triangle id) for each surface triangle at the ball's vertex, once.
template <class F>
void for_each_triangle(const TetMesh& mesh, const Ball& ball, F&& f) {
  for (TetId t : ball.tets) {
    const int opposite = mesh.local_index(t, ball.v);
    for (int k = 0; k < 4; ++k) {
      const FaceLink link = mesh.links[t][k];
      if (k != opposite && link.is_triangle() &&
          mesh.triangles[link.triangle()].sides[0] == FaceLink::to_tet(t, k))
        f(link.triangle());
    }
  }
}

/// Whether v is on a tet of the ball.
bool has_vertex(const TetMesh& mesh, const Ball& ball, VertexId v);
/// Whether v is on a surface triangle at the ball's vertex.
bool has_on_triangle(const TetMesh& mesh, const Ball& ball, VertexId v);

/// The tets at an edge (p, q) in the order of rotation: tet i is (p, q, ring[i], ring[i + 1]),
/// positively oriented. Closed shells have as many ring vertices as tets; open ones one more.
struct Shell {
  VertexId p = kNone, q = kNone;
  std::vector<TetId> tets;
  std::vector<VertexId> ring;
  /// Surface triangles at the edge, with the position of their third vertex in the ring.
  struct At {
    TriangleId triangle;
    int ring;
  };
  std::vector<At> triangles;
  bool closed = false;
  bool cut = false;  ///< ends at the interface of the part

  VertexId ring_at(std::size_t i) const { return ring[i < ring.size() ? i : i - ring.size()]; }
  bool on_surface() const { return !triangles.empty(); }
};

/// \pre t has the edge between its local vertices i and j.
void gather_shell(const TetMesh& mesh, TetId t, int i, int j, Shell& shell);

}  // namespace cavea
