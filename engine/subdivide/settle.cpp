#include "cavea/subdivide/settle.h"

#include <algorithm>
#include <array>
#include <optional>

#include "cavea/base/atomic.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/predicates.h"
#include "cavea/subdivide/subdivide.h"

namespace cavea {
namespace {

/// How often a vertex is drawn back halfway before it goes to the straight midpoint: six times
/// leave a sixty-fourth of the way, which is not worth more tries.
constexpr std::uint8_t kMostHalvings = 6;

class Settling {
 public:
  Settling(const Subdivided& from, TetMesh& out)
      : from_(from),
        out_(out),
        halvings_(from.edges.size(), kAtRest),
        draw_back_(from.edges.size(), 0) {}

  void run() {
    if (!find_displaced()) return;
    do {
      parallel_for(
          from_.mesh.tets.size(), [&](std::size_t t) { judge(TetId(t)); }, 256);
    } while (draw_back());
  }

 private:
  static constexpr std::uint8_t kAtRest = 255;  ///< on the straight midpoint
  /// Least volume in a flat tet: its children cannot all be positive, but need not be inverted.
  static constexpr double kFlatParent = -1;

  bool find_displaced() {
    std::uint8_t any = 0;
    parallel_for(from_.edges.size(), [&](std::size_t k) {
      if (out_.points[from_.first_new + k] == straight(k)) return;
      halvings_[k] = 0;
      atomic_or(any, std::uint8_t{1});
    });
    return any != 0;
  }

  Vec3 straight(std::size_t k) const {
    return (from_.mesh.points[from_.edges.ends(k)[0]] + from_.mesh.points[from_.edges.ends(k)[1]]) *
           0.5;
  }

  bool displaced(VertexId v) const {
    return v >= from_.first_new && halvings_[v - from_.first_new] != kAtRest;
  }

  bool displaced(const std::array<VertexId, 4>& tet) const {
    return std::ranges::any_of(tet, [&](VertexId v) { return displaced(v); });
  }

  /// Six times the volume that a child of tet t must keep, or kFlatParent.
  double least_volume6(TetId t) const {
    const auto [a, b, c, d] = from_.mesh.corners(t);
    return certainly_positive(a, b, c, d) ? volume6(a, b, c, d) * (from_.least_volume_share / 8)
                                          : kFlatParent;
  }

  bool good(TetId child, double least) const {
    const auto [a, b, c, d] = out_.corners(child);
    if (least == kFlatParent) return volume6(a, b, c, d) >= 0;
    return certainly_positive(a, b, c, d) && volume6(a, b, c, d) >= least;
  }

  /// Asks for the displaced vertices of the tet's bad children to be drawn back.
  void judge(TetId t) {
    std::optional<double> least;
    for (TetId child = from_.first_child[t]; child < from_.first_child[t + 1]; ++child) {
      if (!displaced(out_.tets[child])) continue;
      if (!least) least = least_volume6(t);
      if (good(child, *least)) continue;
      for (const VertexId v : out_.tets[child])
        if (displaced(v)) atomic_or(draw_back_[v - from_.first_new], std::uint8_t{1});
    }
  }

  /// \returns whether any vertex moved.
  bool draw_back() {
    std::uint8_t any = 0;
    parallel_for(from_.edges.size(), [&](std::size_t k) {
      if (!draw_back_[k]) return;
      draw_back_[k] = 0;
      Vec3& p = out_.points[from_.first_new + k];
      const bool give_up = ++halvings_[k] > kMostHalvings;
      p = give_up ? straight(k) : (straight(k) + p) * 0.5;
      if (give_up) halvings_[k] = kAtRest;
      out_.vertex_tags[from_.first_new + k] |= tag::kOffSurface;
      atomic_or(any, std::uint8_t{1});
    });
    return any != 0;
  }

  const Subdivided& from_;
  TetMesh& out_;
  std::vector<std::uint8_t> halvings_;   ///< of each new vertex
  std::vector<std::uint8_t> draw_back_;  ///< asked for in this round
};

}  // namespace

void settle(const Subdivided& from, TetMesh& out) { Settling(from, out).run(); }

}  // namespace cavea
