#include "cavea/remesh/detour.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <iterator>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "cavea/base/cancel.h"
#include "cavea/base/parallel.h"
#include "cavea/cavity/mesh_editor.h"
#include "cavea/geometry/centroid.h"
#include "cavea/operator/edge_collapse.h"
#include "cavea/operator/edge_split.h"
#include "cavea/part/region.h"
#include "cavea/pass/cycle.h"
#include "cavea/remesh/asking.h"
#include "cavea/remesh/recipe.h"

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

/// Where no step leads on, so many of the best are gone on from by another one.
constexpr std::size_t kFirstSteps = 3;

struct Step {
  VertexId from, to;  ///< of the edge: from vanishes, unless it is split
  TetId at;           ///< with the edge
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

struct Edge {
  VertexId low, high;
  TetId at;  ///< the lowest known with the edge
};

/// The edges at the vertices of a tet, each once.
std::vector<Edge> edges_at(const TetMesh& mesh, TetId t) {
  std::vector<Edge> edges;
  std::vector<TetId> ball;
  for (const VertexId v : mesh.tets[t]) {
    small_ball(mesh, v, ball);
    for (const TetId n : ball)
      for (const VertexId w : mesh.tets[n])
        if (w != v) edges.push_back({std::min(v, w), std::max(v, w), n});
  }
  const auto ends = [](const Edge& e) { return std::tie(e.low, e.high); };
  std::ranges::sort(edges, {}, [](const Edge& e) { return std::tie(e.low, e.high, e.at); });
  const auto rest = std::ranges::unique(edges, {}, ends);
  edges.erase(rest.begin(), rest.end());
  return edges;
}

/// Nearest edges first; none if they are too many.
std::vector<Step> steps_at(const TetMesh& mesh, TetId t) {
  std::vector<Edge> edges = edges_at(mesh, t);
  if (edges.size() > kMostEdges) return {};
  const Vec3 center = centroid(mesh.corners(t));
  std::ranges::stable_sort(edges, {}, [&](const Edge& e) {
    return distance2((mesh.points[e.low] + mesh.points[e.high]) / 2, center);
  });
  std::vector<Step> steps;
  for (const auto& [a, b, at] : edges) {
    steps.push_back({a, b, at, true});
    steps.push_back({a, b, at, false});
    steps.push_back({b, a, at, false});
  }
  return steps;
}

/// The mesh after a step and mending; none if the step is not possible at all.
std::optional<TetMesh> after_step(const TetMesh& mesh, const Step& step,
                                  const SurfaceModel& surface, const CycleSettings& mending) {
  TetMesh result = mesh;
  {
    OperatorContext context(result, surface);
    context.limits = mending.limits;
    context.limits.quality_ratio = context.limits.quality_floor = kLeastLeft;
    gather_shell(result, step.at, result.local_index(step.at, step.from),
                 result.local_index(step.at, step.to), context.shell);
    MeshEditor editor(result);
    Cavity cavity;
    const Verdict verdict = step.split ? edge_split(context, editor.next_vertex(), cavity)
                                       : edge_collapse(context, false, cavity);
    if (verdict != Verdict::kAccept || !editor.closes(cavity)) return {};
    editor.commit(cavity);
  }
  run_cycle(result, surface, mending);
  return result;
}

/// A mesh that steps lead to.
struct Way {
  TetMesh mesh;
  Poverty left;
};

/// The first ones of the least poverty.
std::vector<Way> best_of(std::vector<Way> ways) {
  std::ranges::stable_sort(ways, std::less<>{}, &Way::left);
  if (ways.size() > kFirstSteps) ways.erase(ways.begin() + kFirstSteps, ways.end());
  return ways;
}

TetId worst_of(const TetMesh& mesh) {
  TetId worst = 0;
  for (TetId t = 0; t < TetId(mesh.tets.size()); ++t)
    if (mesh.tet_alive(t) && (!mesh.tet_alive(worst) || mesh.qualities[t] < mesh.qualities[worst]))
      worst = t;
  return worst;
}

/// Tries steps beside a tet.
class Search {
 public:
  Search(const Job& job, double quality)
      : quality_(quality),
        surface_(job.surface.working_model()),
        mending_(detour_cycle(job.r)),
        cancel_(job.options.cancel) {}

  /// The best few ways, the best first. Not all are tried if some of those before leave nothing
  /// poor.
  std::vector<Way> from(const TetMesh& mesh, TetId t) const {
    const std::vector<Step> steps = steps_at(mesh, t);
    std::vector<Way> ways;
    for (std::size_t begin = 0; begin < steps.size(); begin += kTogether) {
      std::vector<std::optional<TetMesh>> results(std::min(kTogether, steps.size() - begin));
      parallel_tasks(results.size(), [&](std::size_t i) {
        throw_if_cancelled(cancel_);
        results[i] = after_step(mesh, steps[begin + i], surface_, mending_);
      });
      for (std::optional<TetMesh>& result : results)
        if (result) {
          const Poverty left = poverty_of(*result, quality_);
          ways.push_back({*std::move(result), left});
        }
      ways = best_of(std::move(ways));
      if (!ways.empty() && ways[0].left.tets == 0) break;
    }
    return ways;
  }

 private:
  const double quality_;
  const SurfaceModel& surface_;
  const CycleSettings mending_;
  const std::atomic<bool>* cancel_;
};

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
  ask_nothing(mesh);  // but what a step changes: all else was asked before
  const Search search(job, quality);
  // As many poor tets as before are not worth it.
  const std::int64_t before = poverty_of(mesh, quality).tets;
  std::vector<Way> ways = search.from(mesh, local);
  const auto leads_on = [&] { return !ways.empty() && ways[0].left.tets < before; };
  if (!leads_on()) {
    std::vector<Way> longer;
    for (const Way& way : ways)
      std::ranges::move(search.from(way.mesh, worst_of(way.mesh)), std::back_inserter(longer));
    ways = best_of(std::move(longer));
  }
  if (leads_on()) best_ = std::move(ways[0].mesh);
}

void Detour::take() && {
  part_[0].mesh = *std::move(best_);
  std::vector<std::int32_t> labels, &part_of_tet = job_.report.part_of_tet;
  stitch_parts(job_.mesh, part_, labels);
  part_of_tet.resize(job_.mesh.tets.size(), kIdle);
  remove_holes(job_.mesh, part_of_tet);
}

}  // namespace cavea
