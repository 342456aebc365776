#include "cavea/remesh/stubborn.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <utility>

#include "cavea/geometry/centroid.h"
#include "cavea/operator/edge_collapse.h"
#include "cavea/operator/edge_split.h"
#include "cavea/operator/edge_star.h"
#include "cavea/operator/edge_swap.h"
#include "cavea/operator/face_swap.h"
#include "cavea/operator/reconnect.h"
#include "cavea/operator/relocate.h"
#include "cavea/remesh/obstacle.h"

namespace cavea {
namespace {

/// Of tets that are sound, but below the target, only some are named.
constexpr std::size_t kMostSound = 20;
/// Of all: more would tell no more.
constexpr std::size_t kMost = 1000;

std::vector<TetId> worst_tets(const TetMesh& mesh, double below) {
  std::vector<TetId> bad;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (mesh.qualities[t] < below) bad.push_back(TetId(t));
  std::ranges::sort(bad, [&](TetId a, TetId b) {
    return std::pair(mesh.qualities[a], a) < std::pair(mesh.qualities[b], b);
  });
  const auto sound =
      std::ranges::find_if(bad, [&](TetId t) { return mesh.qualities[t] >= kSoundQuality; });
  const std::size_t named = std::max(kMostSound, std::size_t(sound - bad.begin()));
  bad.resize(std::min({bad.size(), named, kMost}));
  return bad;
}

/// Asks the operators about one tet after another.
class Inquiry {
 public:
  Inquiry(const TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings)
      : mesh_(mesh), context_(mesh, surface), settings_(settings) {
    context_.limits = settings.limits;
  }

  StubbornTet operator()(TetId t) {
    verdicts_ = {};
    for (const auto& e : kEdgeVertices) ask_edge(t, e[0], e[1]);
    for (int i = 0; i < 4; ++i) ask_face_and_vertex(t, i);
    add(settings_.swap, Operator::kReconnect, reconnect(context_, t, settings_.collapse, cavity_));
    std::string reason = obstacle_of(context_, t);
    if (reason.empty()) reason = held_by(t);
    return {centroid(mesh_.corners(t)), mesh_.qualities[t], counts_of(verdicts_),
            std::move(reason)};
  }

 private:
  /// What the caller wants left as it is.
  std::string held_by(TetId t) const {
    if (mesh_.tet_flags[t] & tet_flag::kRequired) return "the tetrahedron is required";
    const auto has = [&](Tag tags) {
      return std::ranges::any_of(mesh_.tets[t],
                                 [&](VertexId v) { return (mesh_.vertex_tags[v] & tags) != 0; });
    };
    if (has(tag::kRequired | tag::kOnRequiredEdge)) return "what is required touches it";
    if (settings_.limits.surface_frozen && has(tag::kSurface))
      return "the surface is to stay as it is";
    std::vector<std::string> frozen;
    for (const auto& [allowed, what] :
         {std::pair(settings_.insert, "inserted"), std::pair(settings_.collapse, "collapsed"),
          std::pair(settings_.swap, "swapped"), std::pair(settings_.move, "moved")})
      if (!allowed) frozen.push_back(what);
    return frozen.empty() ? "" : fmt::format("nothing is to be {}", fmt::join(frozen, " or "));
  }

  void add(bool allowed, Operator o, Verdict v) {
    if (allowed) verdicts_.add(o, v);
  }

  void ask_edge(TetId t, int i, int j) {
    const VertexId id = VertexId(mesh_.points.size());
    gather_shell(mesh_, t, i, j, context_.shell);
    const bool is_long =
        context_.length(context_.shell.p, context_.shell.q) > context_.limits.long_edge;
    add(settings_.insert, Operator::kEdgeSplit,
        is_long ? edge_split(context_, id, cavity_) : Verdict::kNotNeeded);
    add(settings_.insert, Operator::kEdgeStar, edge_star(context_, id, cavity_));
    add(settings_.swap, Operator::kEdgeSwap, edge_swap(context_, cavity_));
    add(settings_.collapse, Operator::kEdgeCollapse, edge_collapse(context_, true, cavity_));
    gather_shell(mesh_, t, j, i, context_.shell);
    add(settings_.collapse, Operator::kEdgeCollapse, edge_collapse(context_, true, cavity_));
  }

  void ask_face_and_vertex(TetId t, int i) {
    NewVertex to;
    add(settings_.swap, Operator::kFaceSwap, face_swap(context_, t, i, cavity_));
    add(settings_.move, Operator::kRelocate, relocate(context_, mesh_.tets[t][i], to));
  }

  const TetMesh& mesh_;
  OperatorContext context_;
  const CycleSettings& settings_;
  Cavity cavity_;
  VerdictTable verdicts_;
};

}  // namespace

std::vector<VerdictCount> counts_of(const VerdictTable& table) {
  std::vector<VerdictCount> counts;
  for (int o = 0; o < kOperators; ++o)
    for (int v = 0; v < kVerdicts; ++v)
      if (const std::int64_t n = table.count[std::size_t(o)][std::size_t(v)])
        counts.push_back({name(Operator(o)), name(Verdict(v)), n});
  return counts;
}

std::vector<StubbornTet> find_stubborn(const TetMesh& mesh, const SurfaceModel& surface,
                                       const CycleSettings& settings, double target) {
  Inquiry ask(mesh, surface, settings);
  std::vector<StubbornTet> stubborn;
  for (const TetId t : worst_tets(mesh, std::max(kSoundQuality, target)))
    stubborn.push_back(ask(t));
  return stubborn;
}

}  // namespace cavea
