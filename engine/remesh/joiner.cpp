#include "cavea/remesh/joiner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cavea/remesh/recipe.h"
#include "cavea/remesh/stubborn.h"
#include "cavea/surface/crossings.h"

namespace cavea {

Joiner::Joiner(Job& job, const std::vector<FailedPlace>& failed)
    : job_(job),
      failed_(failed),
      mesh_(job.mesh),
      context_(mesh_, job.surface.working_model()),
      editor_(mesh_) {
  context_.limits = last_phase(job.r).cycle.limits;
  context_.limits.bridges_slits = true;
}

std::int64_t Joiner::run(const std::function<void()>& before_first) {
  before_first_ = before_first;
  std::vector<TetId> queue = unsound_tets(mesh_);
  const auto is_unsound = [&](TetId t) {
    return mesh_.tet_alive(t) && mesh_.qualities[t] < kSoundQuality;
  };
  constexpr std::size_t kMostAsked = 10;  // for each of them, what comes included
  const std::size_t most = kMostAsked * (queue.size() + kMostAsked);
  for (std::size_t i = 0; i < std::min(queue.size(), most); ++i) {
    if (!is_unsound(queue[i]) || !join_at(queue[i])) continue;
    for (const TetId t : editor_.created())
      if (is_unsound(t)) queue.push_back(t);
  }
  return joined_;
}

/// Commits the best, but those first that leave the planes of the exterior boundary as they are: a
/// body of planes keeps its volume.
bool Joiner::join_at(TetId t) {
  std::vector<Candidate> found;
  add_candidates(junctions_of_vertices(mesh_, t), 0, found);
  add_candidates(junctions_in_triangles(context_, t), 1, found);
  std::ranges::stable_sort(found, {}, &Candidate::rank);
  const auto best = std::ranges::find_if(
      found, [&](const Candidate& c) { return editor_.closes(c.cavity) && !crosses(c.cavity); });
  if (best == found.end()) return false;
  commit(*best);
  return true;
}

/// Where an interface meets the exterior boundary, it gives way. \param kind the lower, the better,
/// where planes count alike
void Joiner::add_candidates(const std::vector<Junction>& junctions, int kind,
                            std::vector<Candidate>& found) {
  for (const Junction& j : junctions) {
    const std::optional<double> moved = displacement(j);
    if (!moved) continue;
    Candidate c{{}, {}, *moved};
    const Verdict v = surface_merge(context_, j, kSoundQuality, editor_.next_vertex(), c.cavity);
    job_.verdicts.add(Operator::kSurfaceMerge, v);
    if (v != Verdict::kAccept) continue;
    const bool keeps = keeps_planes(c.cavity);
    if (!keeps && has_interface(c.cavity)) continue;
    const auto worst = std::ranges::min_element(c.cavity.tets, {}, &NewTet::quality);
    c.rank = {!keeps, kind, -worst->quality};
    found.push_back(std::move(c));
  }
}

bool Joiner::has_interface(const Cavity& cavity) const {
  return std::ranges::any_of(cavity.removed_triangles,
                             [&](TriangleId t) { return !mesh_.triangles[t].is_exterior(); });
}

/// Whether the new vertex is in the planes of all triangles of the exterior boundary that go.
bool Joiner::keeps_planes(const Cavity& cavity) const {
  constexpr double kRounding = 1e-12;  // of the cube of what is between them
  const Vec3 m = cavity.vertex.point;
  return std::ranges::all_of(cavity.removed_triangles, [&](TriangleId id) {
    const Triangle& t = mesh_.triangles[id];
    const Vec3 a = mesh_.points[t.v[0]], b = mesh_.points[t.v[1]], c = mesh_.points[t.v[2]];
    const double reach = std::max({distance(a, m), distance(b, m), distance(c, m)});
    return !t.is_exterior() || std::abs(volume6(m, a, b, c)) <= kRounding * reach * reach * reach;
  });
}

/// Of the tolerance, that may be used there.
double Joiner::share_at(const Vec3& place) const {
  constexpr double kLess = 0.75;
  double share = 1;
  for (const FailedPlace& f : failed_)
    if (f.contains(place)) share *= kLess;
  return share;
}

/// The largest of what is moved, with what it was moved before; none if that is too far.
std::optional<double> Joiner::displacement(const Junction& junction) const {
  double farthest = 0;
  const double share = share_at(junction.place);
  for (const Moved& m : moved_by(mesh_, junction)) {
    const auto at = moved_.find(m.vertex);
    const double all = m.distance + (at == moved_.end() ? 0 : at->second);
    if (all > share * std::sqrt(context_.tolerance2(mesh_.anchors[m.vertex]))) return {};
    farthest = std::max(farthest, all);
  }
  return farthest;
}

/// Beside slits, too, all of the tolerance is used up.
bool Joiner::crosses(const Cavity& cavity) const {
  std::vector<PlacedTriangle> placed;
  for (const Triangle& t : cavity.triangles) {
    if (!t.is_exterior()) continue;  // inside
    PlacedTriangle& p = placed.emplace_back(PlacedTriangle{t.v, {}});
    for (std::size_t k = 0; k < 3; ++k)
      p.corners[k] = t.v[k] == editor_.next_vertex() ? cavity.vertex.point : mesh_.points[t.v[k]];
  }
  return would_cross(mesh_, placed, cavity.removed_triangles);
}

void Joiner::commit(const Candidate& candidate) {
  if (joined_++ == 0) before_first_();
  const Cavity& cavity = candidate.cavity;
  const VertexId v = editor_.next_vertex();
  editor_.commit(cavity);
  std::vector<std::int32_t>& parts = job_.report.part_of_tet;
  if (!parts.empty())
    parts.resize(mesh_.tets.size(), parts[std::size_t(cavity.removed_tets.front())]);
  for (const VertexId gone : cavity.removed_vertices) moved_.erase(gone);
  moved_[v] = candidate.moved;
}

}  // namespace cavea
