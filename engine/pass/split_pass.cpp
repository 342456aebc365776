#include <algorithm>
#include <queue>
#include <tuple>

#include "cavea/operator/edge_split.h"
#include "cavea/operator/surface_insert.h"
#include "cavea/pass/passes.h"

namespace cavea {
namespace {

/// An edge to treat, seen from one of its tets.
struct EdgeTask {
  float urgency;  ///< treated from the largest down
  VertexId a, b;  ///< a < b
  TetId tet;
};

enum class Outcome { kDone, kRefused, kGone };

void sort_tasks(std::vector<EdgeTask>& tasks) {
  std::sort(tasks.begin(), tasks.end(), [](const EdgeTask& x, const EdgeTask& y) {
    if (x.urgency != y.urgency) return x.urgency > y.urgency;
    return std::tie(x.a, x.b, x.tet) < std::tie(y.a, y.b, y.tet);
  });
}

/// Calls f(tet, local i, local j, a, b) for the edges of tets that carry the flag.
template <class F>
void for_each_asked_edge(const TetMesh& m, F&& f) {
  for (std::size_t t = 0; t < m.tets.size(); ++t) {
    if (!(m.tet_flags[t] & tet_flag::kAskLength) || !m.tet_alive(TetId(t))) continue;
    for (const auto& e : kEdgeVertices) f(TetId(t), e[0], e[1]);
  }
}

/// Shorter edges are not split for the fit: the sizes follow the curvature, so what still does not
/// fit has other reasons.
constexpr double kFittedLength = 0.9;

/// How far the middle of a surface edge is from the ideal surface, in tolerances; where it is
/// within, perhaps less.
double misfit(const PartState& s, const Triangle& t, int k) {
  const OperatorContext& c = s.context;
  const VertexId a = t.v[(k + 1) % 3], b = t.v[(k + 2) % 3];
  if (distance(c.point(a), c.point(b)) < s.settings.shortest_fitted) return 0;
  if (c.length(a, b) < kFittedLength || ((c.tags(a) | c.tags(b)) & tag::kOffSurface)) return 0;
  const Anchor hints[2] = {c.mesh.anchors[a], c.mesh.anchors[b]};
  const Vec3 middle = (c.point(a) + c.point(b)) / 2;
  const SurfacePoint at =
      t.edge_tag[k] & tag::kFeature
          ? c.surface.place_on_curve(middle, hints)
          : c.surface.place(middle, t.patch, hints, c.limits.tolerance_share);
  return at.anchor.facet == kNone ? 0 : std::sqrt(at.distance2 / c.tolerance2(at.anchor));
}

void add_misfits(const PartState& s, TetId tet, std::vector<EdgeTask>& tasks) {
  const TetMesh& m = s.context.mesh;
  for (int f = 0; f < 4; ++f) {
    const FaceLink link = m.links[tet][f];
    if (!link.is_triangle()) continue;
    const Triangle& t = m.triangles[link.triangle()];
    for (int k = 0; k < 3; ++k)
      if (const double x = misfit(s, t, k); x > 1) {
        const VertexId a = t.v[(k + 1) % 3], b = t.v[(k + 2) % 3];
        tasks.push_back(
            {float(s.context.limits.long_edge * x), std::min(a, b), std::max(a, b), tet});
      }
  }
}

std::vector<EdgeTask> split_tasks(const PartState& s) {
  const TetMesh& m = s.context.mesh;
  const Limits& limits = s.context.limits;
  std::vector<EdgeTask> tasks;
  for_each_asked_edge(m, [&](TetId t, int i, int j) {
    const VertexId a = std::min(m.tets[t][i], m.tets[t][j]),
                   b = std::max(m.tets[t][i], m.tets[t][j]);
    if (s.context.length_exceeds(a, b, limits.long_edge))
      tasks.push_back({float(s.context.length(a, b)), a, b, t});
    if (i == 0 && j == 1 && s.settings.shortest_fitted > 0) add_misfits(s, t, tasks);
  });
  sort_tasks(tasks);
  return tasks;
}

/// Gathers the shell of a task's edge from vertex p to q; false if its tet has it no longer.
bool find_edge(PartState& s, const EdgeTask& task, VertexId p, VertexId q) {
  const TetMesh& m = s.context.mesh;
  if (!m.tet_alive(task.tet)) return false;
  const int i = m.local_index(task.tet, p), j = m.local_index(task.tet, q);
  if (i == 4 || j == 4) return false;
  gather_shell(m, task.tet, i, j, s.context.shell);
  return true;
}

/// Calls work(task) for each task, once an edge unless it is refused for a tet that has changed
/// since.
template <class F>
std::int64_t for_each_task(const std::vector<EdgeTask>& tasks, F&& work) {
  std::int64_t done = 0;
  VertexId last_a = kNone, last_b = kNone;
  for (const EdgeTask& task : tasks) {
    if (task.a == last_a && task.b == last_b) continue;
    const Outcome outcome = work(task);
    if (outcome == Outcome::kGone) continue;
    last_a = task.a, last_b = task.b;
    done += outcome == Outcome::kDone;
  }
  return done;
}

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
class SurfaceQueue {
 public:
  explicit SurfaceQueue(PartState& s) : s_(s), insert_(s.context), old_(s.mesh().points.size()) {
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
    if (!s_.count(Operator::kSurfaceInsert, v)) {
      v = edge_split(s_.context, s_.editor.next_vertex(), s_.cavity);
      if (!s_.count(Operator::kEdgeSplit, v)) return Outcome::kRefused;
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

std::int64_t surface_pass(PartState& s) { return SurfaceQueue(s).run(); }

std::int64_t split_pass(PartState& s) {
  return for_each_task(split_tasks(s), [&](const EdgeTask& task) {
    if (!find_edge(s, task, task.a, task.b)) return Outcome::kGone;
    if (s.editor.living_tets() >= s.settings.most_tets) {
      s.result.full = true;
      s.mesh().tet_flags[task.tet] |= tet_flag::kAskLater;
      return Outcome::kRefused;
    }
    const Verdict v = edge_split(s.context, s.editor.next_vertex(), s.cavity);
    if (v == Verdict::kFrozen) s.mesh().tet_flags[task.tet] |= tet_flag::kAskLater;
    if (!s.count(Operator::kEdgeSplit, v)) return Outcome::kRefused;
    s.commit();
    return Outcome::kDone;
  });
}

}  // namespace cavea
