#include "cavea/implicit/signs.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <utility>

#include "cavea/base/buckets.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/faces.h"

namespace cavea {
namespace {

/// Inside and outside of the tets at one vertex on the interface. Near the vertex each tet is a
/// cone, of one side or cut into one piece of each.
class BallSides {
 public:
  BallSides(const TetMesh& mesh, VertexId v, std::span<const std::uint32_t> ball,
            std::span<const std::int8_t> signs, std::span<const double> values)
      : mesh_(mesh), v_(v), ball_(ball), signs_(signs), values_(values) {
    for (std::size_t i = 0; i < ball.size(); ++i) {
      pieces_.push_back(pieces_of(ball[i]));
      group_.push_back({std::int32_t(i), std::int32_t(i)});
    }
  }

  /// Whether the faces at the vertex join all of the inside, and all of the outside.
  bool in_one_piece_each() {
    for (std::size_t i = 0; i < ball_.size(); ++i) join_across_faces(i);
    return groups(kInside) <= 1 && groups(kOutside) <= 1;
  }

 private:
  static constexpr int kInside = 0, kOutside = 1;
  using Pieces = std::array<bool, 2>;

  Pieces pieces_of(std::uint32_t t) const {
    Pieces out{};
    for (const VertexId w : mesh_.tets[t]) {
      out[kInside] |= signs_[w] < 0;
      out[kOutside] |= signs_[w] > 0;
    }
    if (!out[kInside] && !out[kOutside])
      out[side_of_tet(mesh_.tets[t], signs_, values_) < 0 ? kInside : kOutside] = true;
    return out;
  }

  /// The pieces that a face has; a face on the interface has those of the tet that it is of.
  Pieces pieces_of_face(std::size_t i, int f) const {
    Pieces out{};
    for (const VertexId w : face_vertices(mesh_.tets[ball_[i]], f)) {
      out[kInside] |= signs_[w] < 0;
      out[kOutside] |= signs_[w] > 0;
    }
    return out[kInside] || out[kOutside] ? out : pieces_[i];
  }

  void join_across_faces(std::size_t i) {
    const TetId t = TetId(ball_[i]);
    for (int f = 0; f < 4; ++f) {
      const FaceLink next = mesh_.across(t, f);
      if (mesh_.tets[t][f] == v_ || !next.is_tet()) continue;
      const auto found = std::ranges::find(ball_, std::uint32_t(next.tet()));
      if (found == ball_.end()) continue;
      const auto j = std::size_t(found - ball_.begin());
      const Pieces face = pieces_of_face(i, f);
      for (const int side : {kInside, kOutside})
        if (face[side] && pieces_[j][side]) join(side, i, j);
    }
  }

  void join(int side, std::size_t i, std::size_t j) {
    const std::int32_t from = group_[i][side], to = group_[j][side];
    for (auto& g : group_)
      if (g[side] == from) g[side] = to;
  }

  int groups(int side) const {
    int count = 0;
    std::vector<char> seen(ball_.size(), 0);
    for (std::size_t i = 0; i < ball_.size(); ++i)
      if (pieces_[i][side] && !std::exchange(seen[group_[i][side]], 1)) ++count;
    return count;
  }

  const TetMesh& mesh_;
  const VertexId v_;
  const std::span<const std::uint32_t> ball_;
  const std::span<const std::int8_t> signs_;
  const std::span<const double> values_;
  std::vector<Pieces> pieces_;
  std::vector<std::array<std::int32_t, 2>> group_;
};

bool has_a_say(const TetMesh& mesh, std::span<const char> split, std::size_t t) {
  return mesh.tet_alive(TetId(t)) && (split.empty() || split[t]);
}

Buckets tets_at_vertices(const TetMesh& mesh, std::span<const char> split) {
  return Buckets(mesh.tets.size(), mesh.points.size(), [&](std::size_t t, auto&& put) {
    if (!has_a_say(mesh, split, t)) return;
    for (const VertexId v : mesh.tets[t]) put(v, std::uint32_t(t));
  });
}

std::int8_t sign_off_interface(double value) { return value < 0 ? -1 : 1; }

/// The end of an edge that its zero is too near to; kNone if there is none.
VertexId near_end(VertexId a, VertexId b, std::span<const double> values) {
  if ((values[a] < 0) == (values[b] < 0)) return kNone;
  const double share = values[a] / (values[a] - values[b]);
  return share < kLeastCutShare ? a : share > 1 - kLeastCutShare ? b : kNone;
}

/// Puts all vertices on the interface that the level set passes too near to.
void put_on_interface(const TetMesh& mesh, std::span<const double> values,
                      std::span<const char> split, std::vector<std::int8_t>& signs) {
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    const auto& tet = mesh.tets[t];
    if (!has_a_say(mesh, split, t)) return;
    for (const auto& e : kEdgeVertices)
      if (const VertexId v = near_end(tet[e[0]], tet[e[1]], values); v != kNone)
        std::atomic_ref(signs[v]).store(0, std::memory_order_relaxed);
  });
}

/// Takes those off the interface again that pinch it. \returns whether there were any.
bool take_off_pinched(const TetMesh& mesh, const Buckets& balls, std::span<const double> values,
                      std::vector<std::int8_t>& signs) {
  std::vector<char> pinched(signs.size(), 0);
  parallel_for(signs.size(), [&](std::size_t v) {
    if (signs[v] == 0)
      pinched[v] = !BallSides(mesh, VertexId(v), balls.of(v), signs, values).in_one_piece_each();
  });
  for (std::size_t v = 0; v < signs.size(); ++v)
    if (pinched[v]) signs[v] = sign_off_interface(values[v]);
  return std::ranges::find(pinched, 1) != pinched.end();
}

/// As if no vertex pinched the interface.
std::vector<std::int8_t> near_signs(const TetMesh& mesh, std::span<const double> values,
                                    std::span<const char> split) {
  std::vector<std::int8_t> signs(values.size());
  parallel_for(values.size(), [&](std::size_t v) { signs[v] = sign_off_interface(values[v]); });
  put_on_interface(mesh, values, split, signs);
  return signs;
}

}  // namespace

int side_of_tet(const std::array<VertexId, 4>& tet, std::span<const std::int8_t> signs,
                std::span<const double> values) {
  for (const VertexId v : tet)
    if (signs[v] != 0) return signs[v];
  double sum = 0;
  for (const VertexId v : tet) sum += values[v];
  return sign_off_interface(sum);
}

std::vector<std::int8_t> cut_signs(const TetMesh& mesh, std::span<const double> values,
                                   std::span<const char> split) {
  std::vector<std::int8_t> signs = near_signs(mesh, values, split);
  const Buckets balls = tets_at_vertices(mesh, split);
  // Ends: each pass takes vertices off, and none is put on again.
  while (take_off_pinched(mesh, balls, values, signs)) {
  }
  return signs;
}

std::vector<VertexId> pinching_vertices(const TetMesh& mesh, std::span<const double> values,
                                        std::span<const char> split) {
  const std::vector<std::int8_t> near = near_signs(mesh, values, split),
                                 signs = cut_signs(mesh, values, split);
  std::vector<VertexId> pinching;
  for (std::size_t v = 0; v < signs.size(); ++v)
    if (near[v] == 0 && signs[v] != 0) pinching.push_back(VertexId(v));
  return pinching;
}

}  // namespace cavea
