#include "cavea/operator/edge_swap.h"

#include <algorithm>
#include <array>

namespace cavea {
namespace {

/// Rings with more vertices are left alone: 99.5% have at most 7, and the work grows with the cube.
constexpr int kMaxRing = 10;

/// The best triangulation of a polygon ring[0..n): best_[i][j] is the largest worst quality over
/// the sub-polygon i..j, apex_[i][j] the vertex of the triangle on its side (i, j).
class RingTriangulation {
 public:
  RingTriangulation(const OperatorContext& c, VertexId p, VertexId q, const VertexId* ring, int n)
      : context_(c), p_(p), q_(q), ring_(ring), n_(n) {}

  /// Worst quality of the best triangulation, or 0 if none is better than `threshold`.
  double solve(double threshold) {
    for (int gap = 1; gap < n_; ++gap)
      for (int i = 0; i + gap < n_; ++i)
        best_[i][i + gap] = gap == 1 ? 1.0 : solve(i, i + gap, threshold);
    return best_[0][n_ - 1];
  }

  void fill(std::int32_t ref, Cavity& cavity) const { fill(0, n_ - 1, ref, cavity); }

 private:
  double solve(int i, int j, double threshold) {
    double best = 0;
    for (int k = i + 1; k < j; ++k) {
      const double limit = std::max(best, threshold);
      if (best_[i][k] <= limit || best_[k][j] <= limit) continue;
      const double here = std::min(std::min(best_[i][k], best_[k][j]), triangle(i, k, j, limit));
      if (here > limit) best = here, apex_[i][j] = std::int8_t(k);
    }
    return best;
  }

  /// Worse quality of the two tets on a triangle of the ring; 0 if not above the limit.
  double triangle(int i, int k, int j, double limit) const {
    const VertexId a = ring_[i], b = ring_[k], c = ring_[j];
    const Vec3 x = context_.point(a), y = context_.point(b), z = context_.point(c);
    if (!quality_exceeds(context_.point(q_), x, z, y, limit) ||
        !quality_exceeds(context_.point(p_), x, y, z, limit))
      return 0;
    return std::min(context_.quality(q_, a, c, b), context_.quality(p_, a, b, c));
  }

  void fill(int i, int j, std::int32_t ref, Cavity& cavity) const {
    if (j - i < 2) return;
    const int k = apex_[i][j];
    const VertexId a = ring_[i], b = ring_[k], c = ring_[j];
    cavity.tets.push_back({{p_, a, b, c}, ref, float(context_.quality(p_, a, b, c))});
    cavity.tets.push_back({{q_, a, c, b}, ref, float(context_.quality(q_, a, c, b))});
    fill(i, k, ref, cavity);
    fill(k, j, ref, cavity);
  }

  const OperatorContext& context_;
  VertexId p_, q_;
  const VertexId* ring_;
  int n_;
  std::array<std::array<double, kMaxRing + 1>, kMaxRing + 1> best_;
  std::array<std::array<std::int8_t, kMaxRing + 1>, kMaxRing + 1> apex_;
};

/// Better tets stay, even if the surface without them would fit.
constexpr double kEarBelow = 0.3;

/// Whether the one tet at a smooth edge of the exterior boundary is an ear: poor, and its two other
/// faces inside. Without it these are the surface: for the tets a swap that leaves nothing to fill.
bool is_ear(const OperatorContext& c) {
  const Shell& s = c.shell;
  if (!c.limits.ears_go || s.tets.size() != 1 || s.closed || s.triangles.size() != 2) return false;
  const TetId t = s.tets[0];
  return c.mesh.qualities[t] < kEarBelow &&
         std::ranges::all_of(std::array{s.p, s.q}, [&](VertexId v) {
           return c.mesh.links[t][c.mesh.local_index(t, v)].is_tet();
         });
}

Verdict may_swap(const OperatorContext& c) {
  const Shell& s = c.shell;
  if (s.cut || c.frozen_edge(s.p, s.q)) return Verdict::kFrozen;
  if (c.limits.surface_frozen && s.on_surface()) return Verdict::kBreaksFeature;
  if (s.ring.size() > kMaxRing) return Verdict::kTooLarge;
  for (TetId t : s.tets)
    if (c.mesh.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
  return Verdict::kAccept;
}

/// The smooth surface edge (p, q) of triangles pqa and qpb becomes ab.
Verdict swap_triangles(OperatorContext& c, bool ear, Cavity& cavity) {
  const Shell& s = c.shell;
  if (s.triangles.size() != 2) return Verdict::kBreaksFeature;
  const VertexId a = s.ring[std::size_t(s.triangles[0].ring)],
                 b = s.ring[std::size_t(s.triangles[1].ring)];
  if (c.frozen_edge(a, b)) return Verdict::kFrozen;
  const Triangle& ta = c.mesh.triangles[s.triangles[0].triangle];
  const Triangle& tb = c.mesh.triangles[s.triangles[1].triangle];
  if ((ta.tags | tb.tags) & tag::kRequired) return Verdict::kBreaksFeature;
  auto index = [](const Triangle& t, VertexId v) { return t.v[0] == v ? 0 : t.v[1] == v ? 1 : 2; };
  if (ta.edge_tag[index(ta, a)] & tag::kFeature) return Verdict::kBreaksFeature;
  // An edge ab that exists already would be on the surface twice; an ear has it inside.
  const bool pinched = c.tags(a) & tag::kPinched;  // then not all of its tets are in its ball
  const VertexId center = pinched ? b : a, other = pinched ? a : b;
  if (c.tags(center) & tag::kPinched) return Verdict::kBreaksTopology;
  gather_ball(c.mesh, center, c.marker, c.second_ball);
  if (ear ? has_on_triangle(c.mesh, c.second_ball, other)
          : has_vertex(c.mesh, c.second_ball, other))
    return Verdict::kBreaksTopology;

  for (const VertexId kept : {s.p, s.q}) {
    const VertexId gone = kept == s.p ? s.q : s.p;
    Triangle t = ta;  // (.., gone -> b): keeps the edge from `kept` to a, and takes kept-b from tb
    t.v[index(ta, gone)] = b;
    t.edge_tag[index(ta, kept)] = 0, t.edge_ref[index(ta, kept)] = 0;
    t.edge_tag[index(ta, gone)] = ta.edge_tag[index(ta, gone)];
    t.edge_ref[index(ta, gone)] = ta.edge_ref[index(ta, gone)];
    t.edge_tag[index(ta, a)] = tb.edge_tag[index(tb, gone)];
    t.edge_ref[index(ta, a)] = tb.edge_ref[index(tb, gone)];
    cavity.triangles.push_back(t);
  }
  const Anchor hints[4] = {c.mesh.anchors[s.p], c.mesh.anchors[s.q], c.mesh.anchors[a],
                           c.mesh.anchors[b]};
  cavity.removed_triangles = {s.triangles[0].triangle, s.triangles[1].triangle};
  const auto fit_of_new = [&](std::size_t k) {
    const Triangle& t = cavity.triangles[k];
    return fit_triangle(c, {c.point(t.v[0]), c.point(t.v[1]), c.point(t.v[2])}, t.patch, hints);
  };
  // An ear goes for the sake of the volume alone: what is left must fit, however it fits itself.
  return judge_surface(cavity.triangles.size(), fit_of_new,
                       [&] { return ear ? SurfaceFit{} : fit_of(c, cavity.removed_triangles); });
}

}  // namespace

Verdict edge_swap(OperatorContext& c, Cavity& cavity) {
  cavity.clear();
  const Shell& s = c.shell;
  if (const Verdict v = may_swap(c); v != Verdict::kAccept) return v;
  double before = 1;
  for (TetId t : s.tets) before = std::min(before, double(c.mesh.qualities[t]));
  const double threshold = std::max(kFlat, before * kQualityGain);
  cavity.removed_tets = s.tets;

  if (s.closed && !s.on_surface()) {
    RingTriangulation ring(c, s.p, s.q, s.ring.data(), int(s.ring.size()));
    if (ring.solve(threshold) <= threshold) return Verdict::kWorseQuality;
    ring.fill(c.mesh.tet_refs[s.tets[0]], cavity);
    return Verdict::kAccept;
  }
  if (!s.on_surface()) return Verdict::kFrozen;  // open without a surface: the rim of a part
  if (is_ear(c)) return swap_triangles(c, true, cavity);
  // One sector a side of the surface; on the exterior boundary there is one.
  if (s.triangles.size() != 2) return Verdict::kBreaksFeature;
  const int first = s.triangles[0].ring, second = s.triangles[1].ring, n = int(s.ring.size());
  std::vector<VertexId> sector;
  auto add_sector = [&](int from, int to) {
    sector.clear();
    for (int i = from; i <= to; ++i) sector.push_back(s.ring_at(std::size_t(i)));
    if (sector.size() < 3) return false;
    RingTriangulation ring(c, s.p, s.q, sector.data(), int(sector.size()));
    if (ring.solve(threshold) <= threshold) return false;
    ring.fill(c.mesh.tet_refs[s.tets[std::size_t(from % int(s.tets.size()))]], cavity);
    return true;
  };
  if (!add_sector(std::min(first, second), std::max(first, second))) return Verdict::kWorseQuality;
  if (s.closed && !add_sector(std::max(first, second), std::min(first, second) + n))
    return Verdict::kWorseQuality;
  return swap_triangles(c, false, cavity);
}

}  // namespace cavea
