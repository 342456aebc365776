#include <algorithm>
#include <queue>
#include <tuple>

#include "cavea/operator/edge_split.h"
#include "cavea/operator/surface_insert.h"
#include "cavea/pass/passes.h"

namespace cavea {
namespace {

/// A long surface edge, seen from one of its triangles.
struct SurfaceTask {
  float length;
  VertexId a, b;  ///< a < b
  TriangleId triangle;

  /// Whether it comes after another one.
  bool operator<(const SurfaceTask& other) const {
    if (length != other.length) return length < other.length;
    return std::tie(a, b, triangle) > std::tie(other.a, other.b, other.triangle);
  }
};

/// Surface edges that are to be split, longest first. Those that a split makes are left to the next
/// sweep, but those that it keeps have other triangles then.
class SurfacePass {
 public:
  explicit SurfacePass(PartState& s) : s_(s), insert_(s.context), old_(s.mesh().points.size()) {
    for (std::size_t t = 0; t < s.mesh().triangles.size(); ++t) add_sides(TriangleId(t));
  }

  std::int64_t run() {
    std::int64_t done = 0;
    VertexId last_a = kNone, last_b = kNone;
    while (!queue_.empty()) {
      const SurfaceTask task = queue_.top();
      queue_.pop();
      if (task.a == last_a && task.b == last_b) continue;
      const Outcome outcome = split(task);
      if (outcome == Outcome::kGone) continue;
      last_a = task.a, last_b = task.b;
      done += outcome == Outcome::kDone;
    }
    return done;
  }

 private:
  void add_sides(TriangleId id) {
    const Triangle& t = s_.mesh().triangles[id];
    if (!t.alive()) return;
    for (std::size_t k = 0; k < 3; ++k) {
      const VertexId u = t.v[(k + 1) % 3], w = t.v[(k + 2) % 3];
      const VertexId a = std::min(u, w), b = std::max(u, w);
      if (std::size_t(b) >= old_ || s_.context.frozen_edge(a, b)) continue;
      if (s_.context.length_exceeds(a, b, s_.context.limits.long_edge))
        queue_.push({float(s_.context.length(a, b)), a, b, id});
    }
  }

  enum class Outcome { kDone, kRefused, kGone };

  Outcome split(const SurfaceTask& task) {
    const TetMesh& m = s_.mesh();
    const Triangle& t = m.triangles[task.triangle];
    const auto has = [&](VertexId v) { return std::ranges::find(t.v, v) != t.v.end(); };
    if (!t.alive() || !has(task.a) || !has(task.b)) return Outcome::kGone;
    const FaceLink side = t.sides[t.sides[0].is_tet() ? 0 : 1];
    if (s_.editor.living_tets() >= s_.settings.most_tets) {
      s_.result.full = true;
      return Outcome::kRefused;
    }
    gather_shell(m, side.tet(), m.local_index(side.tet(), task.a),
                 m.local_index(side.tet(), task.b), s_.context.shell);
    Verdict v = insert_(s_.editor.next_vertex(), s_.cavity);
    if (!s_.takes(Operator::kSurfaceInsert, v)) {
      v = edge_split(s_.context, s_.editor.next_vertex(), s_.cavity);
      if (!s_.takes(Operator::kEdgeSplit, v)) return Outcome::kRefused;
    }
    s_.commit();
    for (const TetId created : s_.editor.created())
      for (const FaceLink link : m.links[created])
        if (link.is_triangle()) add_sides(link.triangle());
    return Outcome::kDone;
  }

  PartState& s_;
  SurfaceInsert insert_;
  std::size_t old_;  ///< vertices that were there before
  std::priority_queue<SurfaceTask> queue_;
};

}  // namespace

std::int64_t surface_pass(PartState& s) { return SurfacePass(s).run(); }

}  // namespace cavea
