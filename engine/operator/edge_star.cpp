#include "cavea/operator/edge_star.h"

#include "cavea/operator/pattern_search.h"

namespace cavea {
namespace {

/// First step of the search for the vertex, in lengths of the edge.
constexpr double kFirstStep = 0.25;
/// The new vertex must gain more than a swap to be worth a vertex.
constexpr double kStarGain = 1.2;

/// Calls f(p, q, r, t, tet) for the two children of each tet of the shell, `x` standing for the
/// vertex.
template <class F>
bool for_each_child(const OperatorContext& c, const Vec3& x, F&& f) {
  const Shell& s = c.shell;
  for (std::size_t i = 0; i < s.tets.size(); ++i) {
    const Vec3 r = c.point(s.ring_at(i)), t = c.point(s.ring_at(i + 1));
    if (!f(c.point(s.p), x, r, t) || !f(x, c.point(s.q), r, t)) return false;
  }
  return true;
}

/// Worst quality of the star, or `limit` where it does not exceed that.
double worst_of_star(const OperatorContext& c, const Vec3& x, double limit) {
  double worst = 1;
  const bool above =
      for_each_child(c, x, [&](const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& t) {
        worst = std::min(worst, tet_quality(p, q, r, t));
        return worst > limit;
      });
  return above ? worst : limit;
}

}  // namespace

Verdict edge_star(OperatorContext& c, VertexId id, Cavity& cavity) {
  cavity.clear();
  const Shell& s = c.shell;
  if (s.on_surface()) return Verdict::kBreaksFeature;
  if (s.cut || !s.closed || c.frozen_edge(s.p, s.q)) return Verdict::kFrozen;
  double before = 1;
  for (TetId t : s.tets) {
    before = std::min(before, double(c.mesh.qualities[t]));
    if (c.mesh.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
  }
  NewVertex v;
  v.point = (c.point(s.p) + c.point(s.q)) / 2;
  v.size = (c.mesh.sizes[s.p] + c.mesh.sizes[s.q]) / 2;
  double best = worst_of_star(c, v.point, 0);
  v.point = pattern_search(v.point, kFirstStep * distance(c.point(s.p), c.point(s.q)), best,
                           [&](const Vec3& x, double limit) { return worst_of_star(c, x, limit); });
  if (best <= std::max(kFlat, kStarGain * before)) return Verdict::kWorseQuality;
  cavity.inserts_vertex = true;
  cavity.vertex = v;
  cavity.removed_tets = s.tets;
  const std::int32_t ref = c.mesh.tet_refs[s.tets[0]];
  for (std::size_t i = 0; i < s.tets.size(); ++i) {
    const VertexId r = s.ring_at(i), t = s.ring_at(i + 1);
    const Vec3 a = c.point(s.p), b = c.point(s.q), x = c.point(r), y = c.point(t);
    cavity.tets.push_back({{s.p, id, r, t}, ref, float(tet_quality(a, v.point, x, y))});
    cavity.tets.push_back({{id, s.q, r, t}, ref, float(tet_quality(v.point, b, x, y))});
  }
  return Verdict::kAccept;
}

}  // namespace cavea
