#include "cavea/remesh/detour.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "cavea/base/cancel.h"
#include "cavea/base/keep_once.h"
#include "cavea/base/parallel.h"
#include "cavea/cavity/mesh_editor.h"
#include "cavea/geometry/centroid.h"
#include "cavea/operator/edge_collapse.h"
#include "cavea/operator/edge_split.h"
#include "cavea/part/region.h"
#include "cavea/pass/cycle.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/recipe.h"
#include "cavea/remesh/standing.h"

namespace cavea {
namespace {

/// Of tets around the poor one that mending may change.
constexpr int kReach = 5;

/// Balls of needles reach far, and have hundreds of edges: there each way out would take long, and
/// none leads on. Around sound tets there are some 2,000 tets, and 50 edges.
constexpr std::size_t kMostTets = 20'000, kMostEdges = 100;

/// What the operation may leave to be mended.
constexpr double kLeastLeft = 0.03;

/// Steps that are tried before it is asked whether one of them leaves nothing poor.
constexpr std::size_t kTogether = 24;

struct Step {
  VertexId from, to;  ///< of the edge: from vanishes, unless it is split
  bool split;
};

/// How poor a mesh is; the less the better.
struct Poverty {
  std::int64_t tets = 0;
  double lacking = 0;  ///< of all of them together

  bool operator<(const Poverty& other) const {
    return std::tie(tets, lacking) < std::tie(other.tets, other.lacking);
  }
};

Poverty poverty_of(const TetMesh& mesh, double quality) {
  Poverty poverty;
  for (TetId t = 0; t < TetId(mesh.tets.size()); ++t) {
    if (!mesh.tet_alive(t) || mesh.qualities[t] >= quality) continue;
    ++poverty.tets;
    poverty.lacking += quality - mesh.qualities[t];
  }
  return poverty;
}

/// The edges at the vertices of a tet, each once.
std::vector<std::pair<VertexId, VertexId>> edges_at(const TetMesh& mesh, TetId t) {
  std::vector<std::pair<VertexId, VertexId>> edges;
  std::vector<TetId> ball;
  for (const VertexId v : mesh.tets[t]) {
    small_ball(mesh, v, ball);
    for (const TetId n : ball)
      for (const VertexId w : mesh.tets[n])
        if (w != v) edges.emplace_back(std::min(v, w), std::max(v, w));
  }
  keep_once(edges);
  return edges;
}

/// Nearest edges first; none if they are too many.
std::vector<Step> steps_at(const TetMesh& mesh, TetId t) {
  auto edges = edges_at(mesh, t);
  if (edges.size() > kMostEdges) return {};
  const Vec3 center = centroid(mesh.corners(t));
  std::ranges::stable_sort(edges, {}, [&](const auto& e) {
    return distance2((mesh.points[e.first] + mesh.points[e.second]) / 2, center);
  });
  std::vector<Step> steps;
  for (const auto& [a, b] : edges) {
    steps.push_back({a, b, true});
    steps.push_back({a, b, false});
    steps.push_back({b, a, false});
  }
  return steps;
}

/// Puts the shell of an edge into the context.
void gather_edge(OperatorContext& context, VertexId from, VertexId to) {
  const TetMesh& mesh = context.mesh;
  std::vector<TetId> ball;
  small_ball(mesh, from, ball);
  const TetId t = *std::ranges::find_if(ball, [&](TetId n) { return mesh.local_index(n, to) < 4; });
  gather_shell(mesh, t, mesh.local_index(t, from), mesh.local_index(t, to), context.shell);
}

/// The mesh after a step and mending; none if the step is not possible at all.
std::optional<TetMesh> after_step(const TetMesh& mesh, const Step& step,
                                  const SurfaceModel& surface, const CycleSettings& mending) {
  TetMesh result = mesh;
  {
    OperatorContext context(result, surface);
    context.limits = mending.limits;
    context.limits.quality_ratio = context.limits.quality_floor = kLeastLeft;
    gather_edge(context, step.from, step.to);
    MeshEditor editor(result);
    Cavity cavity;
    const Verdict verdict = step.split ? edge_split(context, editor.next_vertex(), cavity)
                                       : edge_collapse(context, false, cavity);
    if (verdict != Verdict::kAccept) return {};
    editor.commit(cavity);
  }
  run_cycle(result, surface, mending);
  return result;
}

std::vector<Part> part_around(const TetMesh& mesh, TetId t) {
  std::vector<std::int32_t> labels(mesh.tets.size(), kIdle);
  for (const TetId n : with_layers_of_few(mesh, {t}, kReach)) labels[n] = 0;
  return extract_parts(mesh, labels, 1);
}

}  // namespace

Detour::Detour(Job& job, TetId t, double quality) : job_(job), part_(part_around(job.mesh, t)) {
  TetMesh& mesh = part_[0].mesh;
  const auto local = TetId(std::ranges::lower_bound(part_[0].tets, t) - part_[0].tets.begin());
  if (mesh.tets.size() > kMostTets) return;
  ask_nothing(mesh);
  ask_below(mesh, kPoorQuality);
  const CycleSettings mending = detour_cycle(job.r);
  const SurfaceModel& surface = job.surface.working_model();
  const std::vector<Step> steps = steps_at(mesh, local);
  Poverty least = poverty_of(mesh, quality);
  least.lacking = 0;  // as many poor tets as before are not worth it
  for (std::size_t begin = 0; begin < steps.size() && least.tets > 0; begin += kTogether) {
    std::vector<std::optional<TetMesh>> results(std::min(kTogether, steps.size() - begin));
    parallel_tasks(results.size(), [&](std::size_t i) {
      throw_if_cancelled(job.options.cancel);
      results[i] = after_step(mesh, steps[begin + i], surface, mending);
    });
    for (std::optional<TetMesh>& result : results) {
      if (!result) continue;
      const Poverty left = poverty_of(*result, quality);
      if (left < least) least = left, best_ = std::move(result);
    }
  }
}

void Detour::take() && {
  part_[0].mesh = *std::move(best_);
  std::vector<std::int32_t> labels, &part_of_tet = job_.report.part_of_tet;
  stitch_parts(job_.mesh, part_, labels);
  part_of_tet.resize(job_.mesh.tets.size(), kIdle);
  remove_holes(job_.mesh, part_of_tet);
}

}  // namespace cavea
