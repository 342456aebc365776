#include "cavea/implicit/refine.h"

#include <algorithm>
#include <utility>

#include "cavea/base/atomic.h"
#include "cavea/base/buckets.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/box_tree.h"
#include "cavea/implicit/bisect.h"
#include "cavea/implicit/facet.h"
#include "cavea/implicit/longest_edges.h"
#include "cavea/mesh/local.h"

namespace cavea {
namespace {

/// Where a chord is a tolerance off, its ends' tangents are four at the other end: what is farther
/// on the wrong side of a tangent plane is another sheet.
constexpr double kTangentReach = 4;

/// A pass halves one edge of a tet; three passes halve a tet. No mesh has a ratio of sizes that
/// needs more.
constexpr int kMostPasses = 300;

enum class State : char { kAsk, kStay, kDivide };

class Refinement {
 public:
  Refinement(TetMesh& mesh, const LevelSet& level_set, std::span<const OrientedPoint> zeros,
             const RefineOptions& options)
      : mesh_(mesh), level_set_(level_set), zeros_(zeros), options_(options) {
    states_.assign(mesh.tets.size(), State::kAsk);
    value_from(0);
    locate();
  }

  int run() {
    for (int pass = 0; pass < kMostPasses; ++pass) {
      judge();
      std::vector<char> wanted(states_.size());
      parallel_for(wanted.size(), [&](std::size_t t) { wanted[t] = states_[t] == State::kDivide; });
      const Bisection bisection = choose_longest_edges(mesh_, std::move(wanted));
      if (bisection.edges.empty()) return pass;
      divide(bisection);
    }
    return kMostPasses;
  }

 private:
  void value_from(std::size_t first) {
    values_.resize(mesh_.points.size());
    parallel_for(values_.size() - first, [&](std::size_t k) {
      values_[first + k] = level_set_.value(mesh_.points[first + k]);
    });
  }

  /// Finds the tet of each zero; those outside of the mesh have none and are dropped.
  void locate() {
    std::vector<Box> boxes(mesh_.tets.size());
    parallel_for(boxes.size(), [&](std::size_t t) {
      for (const Vec3& p : mesh_.corners(TetId(t))) boxes[t].add(p);
    });
    const BoxTree tree(boxes);
    tet_of_zero_.assign(zeros_.size(), kNone);
    parallel_for(zeros_.size(), [&](std::size_t z) {
      const Vec3& p = zeros_[z].place;
      double best = -kOutside;
      tree.visit_overlapping({p, p}, [&](std::size_t slot) {
        const TetId t = tree.order()[slot];
        if (const double depth = depth_in(t, p); depth > best) best = depth, tet_of_zero_[z] = t;
      });
    });
  }

  /// The smallest barycentric coordinate of a point in a tet: negative outside.
  double depth_in(TetId t, const Vec3& p) const {
    const auto [a, b, c, d] = mesh_.corners(t);
    return std::min({volume6(p, b, c, d), volume6(a, p, c, d), volume6(a, b, p, d),
                     volume6(a, b, c, p)}) /
           volume6(a, b, c, d);
  }

  void judge() {
    const Buckets zeros_of_tet(zeros_.size(), mesh_.tets.size(), [&](std::size_t z, auto&& put) {
      const TetId t = tet_of_zero_[z];
      if (t != kNone && states_[t] == State::kAsk) put(t, std::uint32_t(z));
    });
    parallel_for(
        states_.size(),
        [&](std::size_t t) {
          if (states_[t] == State::kAsk)
            states_[t] = is_to_divide(TetId(t), zeros_of_tet.of(t)) ? State::kDivide : State::kStay;
        },
        64);
  }

  bool is_to_divide(TetId t, std::span<const std::uint32_t> zeros) const {
    const auto corners = mesh_.corners(t);
    const auto& e = kEdgeVertices[longest_edge(mesh_, t)];
    if (distance(corners[e[0]], corners[e[1]]) <= options_.shortest) return false;
    std::array<double, 4> values;
    for (int k = 0; k < 4; ++k) values[k] = values_[mesh_.tets[t][k]];
    if (is_crossed(values) && is_cut_off_by(options_.tolerance, level_set_, corners, values))
      return true;
    return std::ranges::any_of(zeros, [&](std::uint32_t z) {
      return is_beyond(zeros_[z], kTangentReach * options_.tolerance, corners, values);
    });
  }

  void divide(const Bisection& bisection) {
    const std::size_t vertices = mesh_.points.size();
    std::vector<TetId> second(mesh_.tets.size());
    parallel_for(second.size(), [&](std::size_t t) { second[t] = bisection.of_tet[t]; });
    exclusive_scan(second);
    const TetId before = TetId(mesh_.tets.size());
    bisect(mesh_, bisection);
    value_from(vertices);
    states_.resize(mesh_.tets.size(), State::kAsk);
    parallel_for(second.size(), [&](std::size_t t) {
      if (bisection.of_tet[t]) states_[t] = State::kAsk;
    });
    parallel_for(zeros_.size(), [&](std::size_t z) {
      TetId& t = tet_of_zero_[z];
      if (t == kNone || !bisection.of_tet[t]) return;
      const Vec3& p = zeros_[z].place;
      const TetId other = before + second[t];
      if (depth_in(other, p) > depth_in(t, p)) t = other;
    });
  }

  /// Zeros this far outside of all tets, in barycentric coordinates, are not in the mesh.
  static constexpr double kOutside = 1e-9;

  TetMesh& mesh_;
  const LevelSet& level_set_;
  const std::span<const OrientedPoint> zeros_;
  const RefineOptions options_;
  std::vector<double> values_;  ///< at the vertices
  std::vector<State> states_;   ///< of the tets
  std::vector<TetId> tet_of_zero_;
};

}  // namespace

int refine_near(TetMesh& mesh, const LevelSet& level_set, std::span<const OrientedPoint> zeros,
                const RefineOptions& options) {
  return Refinement(mesh, level_set, zeros, options).run();
}

}  // namespace cavea
