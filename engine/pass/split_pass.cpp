#include <algorithm>
#include <tuple>

#include "cavea/operator/edge_split.h"
#include "cavea/pass/asked_edges.h"
#include "cavea/pass/passes.h"

namespace cavea {
namespace {

/// An edge to treat, seen from one of its tets.
struct EdgeTask {
  float urgency;  ///< treated from the largest down
  VertexId a, b;  ///< a < b
  TetId tet;
  bool for_fit;  ///< to the surface
};

enum class Outcome { kDone, kRefused, kGone };

void sort_tasks(std::vector<EdgeTask>& tasks) {
  std::sort(tasks.begin(), tasks.end(), [](const EdgeTask& x, const EdgeTask& y) {
    if (x.urgency != y.urgency) return x.urgency > y.urgency;
    return std::tie(x.a, x.b, x.tet) < std::tie(y.a, y.b, y.tet);
  });
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
  const SurfacePoint at = t.edge_tag[k] & tag::kFeature
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
            {float(s.context.limits.long_edge * x), std::min(a, b), std::max(a, b), tet, true});
      }
  }
}

std::vector<EdgeTask> split_tasks(const PartState& s) {
  const TetMesh& m = s.context.mesh;
  const double limit = s.context.limits.long_edge;
  std::vector<EdgeTask> tasks;
  for_each_asked_edge(
      m, [&](LengthBlock & block) -> auto& { return block.perhaps_above(limit); },
      [&](TetId t, VertexId i, VertexId j) {
        const VertexId a = std::min(i, j), b = std::max(i, j);
        if (s.context.length_exceeds(a, b, limit))
          tasks.push_back({float(s.context.length(a, b)), a, b, t, false});
      });
  if (s.settings.shortest_fitted > 0)
    for (std::size_t t = 0; t < m.tets.size(); ++t)
      if (is_asked_for_lengths(m, t)) add_misfits(s, TetId(t), tasks);
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

}  // namespace

std::int64_t split_pass(PartState& s) {
  return for_each_task(split_tasks(s), [&](const EdgeTask& task) {
    if (!find_edge(s, task, task.a, task.b)) return Outcome::kGone;
    if (s.editor.living_tets() >= s.settings.most_tets) {
      s.result.full = true;
      s.mesh().tet_flags[task.tet] |= tet_flag::kAskLater;
      return Outcome::kRefused;
    }
    const Verdict v = edge_split(s.context, s.editor.next_vertex(), s.cavity, task.for_fit);
    if (v == Verdict::kFrozen && s.at_interface(task.a) && s.at_interface(task.b))
      s.block(task.tet);
    if (!s.takes(Operator::kEdgeSplit, v)) return Outcome::kRefused;
    s.commit();
    return Outcome::kDone;
  });
}

}  // namespace cavea
