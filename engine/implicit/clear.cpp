#include "cavea/implicit/clear.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cavea/base/atomic.h"
#include "cavea/base/parallel.h"
#include "cavea/implicit/facet.h"
#include "cavea/implicit/signs.h"
#include "cavea/implicit/vertex_moves.h"

namespace cavea {
namespace {

/// A vertex nearer to the level set than this share of its shortest edge is moved. Bisected Kuhn
/// tets are at least a third of that edge high, so that they stay well shaped.
constexpr double kNear = 0.3;

/// A vertex this share of its shortest edge off the level set is on it.
constexpr double kOn = 1e-6;

constexpr MoveLimits kLimits{.share = 0.5, .floor = 0.3};

/// A vertex that is moved away may leave others to pinch the interface: then once more.
constexpr int kMostRounds = 8;

class Clearing {
 public:
  Clearing(TetMesh& mesh, const LevelSet& level_set, double tolerance, const ClearScope& scope)
      : mesh_(mesh),
        level_set_(level_set),
        tolerance_(tolerance),
        scope_(scope),
        moves_(mesh),
        values_(mesh.points.size()),
        earlier_(interface_vertices(mesh, scope.earlier)) {
    evaluate();
  }

  void run() {
    for (const VertexId v : at_crossed_edges())
      if (!is_fixed(v)) move_onto(v);
    evaluate();  // as the cut will see them
    for (int round = 0; round < kMostRounds; ++round) {
      const std::vector<VertexId> pinching = pinching_vertices(mesh_, values_, scope_.split);
      if (pinching.empty()) return;
      for (const VertexId v : pinching)
        if (!is_fixed(v) && earlier_at(v).empty()) move_away(v);
    }
  }

 private:
  bool is_fixed(VertexId v) const { return !scope_.fixed.empty() && scope_.fixed[v]; }
  bool is_split(TetId t) const { return scope_.split.empty() || scope_.split[t]; }

  /// The earlier level sets that a vertex is on.
  std::span<const std::size_t> earlier_at(VertexId v) const {
    const auto found = std::ranges::lower_bound(earlier_, v, {}, &InterfaceVertex::id);
    if (found == earlier_.end() || found->id != v) return {};
    return found->level_sets;
  }

  void evaluate() {
    parallel_for(values_.size(),
                 [&](std::size_t v) { values_[v] = level_set_.value(mesh_.points[v]); });
  }

  std::vector<VertexId> at_crossed_edges() const {
    std::vector<char> is_end(values_.size(), 0);
    parallel_for(mesh_.tets.size(), [&](std::size_t t) {
      const auto& tet = mesh_.tets[t];
      for (const auto& e : kEdgeVertices)
        if (is_split(TetId(t)) && (values_[tet[e[0]]] < 0) != (values_[tet[e[1]]] < 0))
          for (const int k : {e[0], e[1]}) atomic_or(is_end[tet[k]], char{1});
    });
    std::vector<VertexId> ends;
    for (std::size_t v = 0; v < is_end.size(); ++v)
      if (is_end[v]) ends.push_back(VertexId(v));
    return ends;
  }

  void move_onto(VertexId v) {
    const Vec3 from = mesh_.points[v];
    const double edge = moves_.shortest_edge(v), before = values_[v];
    const double slope = norm(level_set_.gradient(from));
    if (!(std::abs(before) < kNear * edge * slope)) return;
    // A sheet that is thinner than an edge would be lost with its only layer of vertices.
    if (!is_on_side_of(v, from + away(v) * edge)) return;
    const auto stays_near = [&](std::span<const TetId> ball) {
      values_[v] = level_set_.value(mesh_.points[v]);
      if (std::abs(values_[v]) < kOn * edge * slope) values_[v] = 0;  // of no sign
      return std::ranges::none_of(ball, [&](TetId t) { return is_split(t) && is_off(t); });
    };
    std::vector<const LevelSet*> wanted = {&level_set_};
    for (const std::size_t k : earlier_at(v)) wanted.push_back(&scope_.earlier[k].level_set);
    if (!moves_.move(v, moves_.to_zero(v, wanted, 2 * kNear * edge), kLimits, stays_near))
      values_[v] = before;
  }

  void move_away(VertexId v) {
    const Vec3 step = moves_.along_boundary(v, away(v) * (kNear * moves_.shortest_edge(v)));
    if (is_on_side_of(v, mesh_.points[v] + step) && moves_.move(v, step, kLimits))
      values_[v] = level_set_.value(mesh_.points[v]);
  }

  /// The direction that leads deeper into a vertex's side; none where the function is flat.
  Vec3 away(VertexId v) const {
    const Vec3 outwards = normalized(level_set_.gradient(mesh_.points[v]));
    if (!is_finite(outwards)) return {};
    return values_[v] < 0 ? -outwards : outwards;
  }
  bool is_on_side_of(VertexId v, const Vec3& place) const {
    return (level_set_.value(place) < 0) == (values_[v] < 0);
  }

  /// A tet with all its corners on the level set is of no side.
  bool is_off(TetId t) const {
    std::array<double, 4> values;
    for (int k = 0; k < 4; ++k) values[k] = values_[mesh_.tets[t][k]];
    if (values == std::array<double, 4>{}) return true;
    return is_crossed(values) && is_cut_off_by(tolerance_, level_set_, mesh_.corners(t), values);
  }

  TetMesh& mesh_;
  const LevelSet& level_set_;
  const double tolerance_;
  const ClearScope& scope_;
  VertexMoves moves_;
  std::vector<double> values_;
  const std::vector<InterfaceVertex> earlier_;
};

}  // namespace

void clear_for_cut(TetMesh& mesh, const LevelSet& level_set, double tolerance,
                   const ClearScope& scope) {
  Clearing(mesh, level_set, tolerance, scope).run();
}

}  // namespace cavea
