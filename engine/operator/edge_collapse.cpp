#include "cavea/operator/edge_collapse.h"

#include <algorithm>

#include "cavea/geometry/closest.h"

namespace cavea {
namespace {

/// Where the worst quality is below this, lengths come second: a vertex between two walls that
/// nearly touch can only vanish along edges that are long.
constexpr double kNeedle = 0.1, kNeedleLong = 3;

int index_in(const Triangle& t, VertexId v) {
  return t.v[0] == v ? 0 : t.v[1] == v ? 1 : t.v[2] == v ? 2 : 3;
}

/// May p vanish into q? The table of section 4.1.2: interior onto all; smooth surface along the
/// surface; feature vertices along their own curve; corners, required and frozen vertices never.
Verdict may_merge(const OperatorContext& c) {
  const Shell& s = c.shell;
  const Tag p = c.tags(s.p);
  if (p & tag::kFrozen) return Verdict::kFrozen;
  if (p & (tag::kCorner | tag::kRequired)) return Verdict::kBreaksFeature;
  if (p & tag::kPinched) return Verdict::kBreaksTopology;
  if (!(p & tag::kSurface)) return Verdict::kAccept;
  if (c.limits.surface_frozen) return Verdict::kBreaksFeature;
  if (!s.on_surface()) return Verdict::kBreaksTopology;
  for (const auto& at : s.triangles) {
    const Triangle& t = c.mesh.triangles[at.triangle];
    const int ip = index_in(t, s.p), iq = index_in(t, s.q);
    const Tag edge = t.edge_tag[3 - ip - iq];
    if (bool(p & tag::kOnCurve) != bool(edge & tag::kFeature)) return Verdict::kBreaksFeature;
    if ((edge | t.tags) & tag::kRequired) return Verdict::kBreaksFeature;
    // The triangle vanishes and its edge at p merges with its edge at q: a feature edge there would
    // meet itself (a closed curve of three edges) or pass to a triangle outside the cavity.
    if (t.edge_tag[iq] & tag::kFeature) return Verdict::kBreaksFeature;
  }
  return Verdict::kAccept;
}

bool is_third(const Shell& s, VertexId v) {
  for (const auto& at : s.triangles)
    if (s.ring[std::size_t(at.ring)] == v) return true;
  return false;
}

bool has(const TetMesh& m, TetId t, VertexId v) { return m.local_index(t, v) < 4; }

/// May edge qr, which is there inside, come to the surface? Between it and the surface at p there
/// must be nothing but tets that vanish. Exterior boundary only: interfaces have both sides.
bool may_surface(const OperatorContext& c, VertexId r) {
  const Shell& s = c.shell;
  const auto is_exterior = [&](TriangleId id) { return !c.mesh.triangles[id].sides[1].is_tet(); };
  return std::ranges::all_of(c.fan, is_exterior) && !(c.tags(r) & tag::kPinched) &&
         std::ranges::any_of(s.tets, [&](TetId t) { return has(c.mesh, t, r); }) &&
         !has_on_triangle(c.mesh, c.second_ball, r);
}

/// Whether there is a face qab that stays, and would be the place of the new triangle, too: but
/// where the tet between the two vanishes, it is to come to the surface.
bool is_face_in_the_way(const OperatorContext& c, VertexId a, VertexId b) {
  const auto has_both = [&](TetId t) { return has(c.mesh, t, a) && has(c.mesh, t, b); };
  const auto stays = [&](TetId t) { return !has(c.mesh, t, c.shell.p); };
  return std::ranges::any_of(c.second_ball.tets,
                             [&](TetId t) { return has_both(t) && stays(t); }) &&
         std::ranges::none_of(c.shell.tets, has_both);
}

/// Link condition (Dey, Edelsbrunner, Guha, Nekhayev 1999) on the surface: a vertex next to p on
/// the surface and next to q at all is a third vertex of a triangle at pq, or only tets that vanish
/// are between, and no new surface triangle is there already. Positive volumes do not see such
/// pinches.
Verdict check_link(OperatorContext& c) {
  const Shell& s = c.shell;
  // Not all of q's tets would be in its ball.
  if (c.tags(s.q) & tag::kPinched) return Verdict::kBreaksTopology;
  Ball& ball_q = c.second_ball;
  gather_ball(c.mesh, s.q, c.marker, ball_q);
  const bool q_frozen = c.tags(s.q) & tag::kFrozen;
  for (TriangleId id : c.fan) {
    const Triangle& t = c.mesh.triangles[id];
    if (index_in(t, s.q) < 3) continue;
    const int ip = index_in(t, s.p);
    const VertexId a = t.v[(ip + 1) % 3], b = t.v[(ip + 2) % 3];
    // Triangle qab could be there, or its place be a face of the interface.
    if (q_frozen && (c.tags(a) & c.tags(b) & tag::kFrozen)) return Verdict::kFrozen;
    bool comes_up = false;
    for (VertexId r : {a, b}) {
      if (is_third(s, r)) continue;
      // An edge qr could stand in another part, out of sight.
      if (q_frozen && (c.tags(r) & tag::kFrozen)) return Verdict::kFrozen;
      if (!has_vertex(c.mesh, ball_q, r)) continue;
      if (!may_surface(c, r)) return Verdict::kBreaksTopology;
      comes_up = true;
    }
    if (comes_up && is_face_in_the_way(c, a, b)) return Verdict::kBreaksTopology;
    bool exists = false;
    for_each_triangle(c.mesh, ball_q, [&](TriangleId other) {
      const Triangle& o = c.mesh.triangles[other];
      exists |= index_in(o, a) < 3 && index_in(o, b) < 3;
    });
    if (exists) return Verdict::kBreaksTopology;
  }
  return Verdict::kAccept;
}

/// The fan's triangles with q in place of p; edges that merge take the tag of the one at q.
void make_triangles(const OperatorContext& c, const std::vector<TriangleId>& fan, Cavity& cavity) {
  const Shell& s = c.shell;
  cavity.removed_triangles = fan;
  for (TriangleId id : fan) {
    Triangle t = c.mesh.triangles[id];
    if (index_in(t, s.q) < 3) continue;
    const int ip = index_in(t, s.p);
    t.v[ip] = s.q;
    for (const auto& at : s.triangles) {
      const Triangle& gone = c.mesh.triangles[at.triangle];
      const VertexId third = s.ring[std::size_t(at.ring)];
      for (int k = 0; k < 3; ++k)
        if (k != ip && t.v[3 - ip - k] == third) {
          t.edge_tag[k] = gone.edge_tag[index_in(gone, s.p)];
          t.edge_ref[k] = gone.edge_ref[index_in(gone, s.p)];
        }
    }
    cavity.triangles.push_back(t);
  }
}

/// Sides of a new triangle that were not there before: neither of the rim nor where edges merge.
unsigned new_sides(const Shell& s, const Triangle& t) {
  const auto i = std::size_t(index_in(t, s.q)), next = (i + 1) % 3, before = (i + 2) % 3;
  unsigned sides = sides_at(t, i);
  if (is_third(s, t.v[next])) sides &= ~(1u << i);
  if (is_third(s, t.v[before])) sides &= ~(1u << before);
  return sides;
}

/// The new surface stays near the ideal one, and near the vertex that goes unless that was off it.
Verdict check_surface(const OperatorContext& c, const Cavity& cavity) {
  const Shell& s = c.shell;
  const Vec3 p = c.point(s.p);
  auto corners = [&](const Triangle& t) {
    return std::array<Vec3, 3>{c.point(t.v[0]), c.point(t.v[1]), c.point(t.v[2])};
  };
  if (!(c.tags(s.p) & tag::kOffSurface)) {
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const Triangle& t : cavity.triangles) {
      const std::array<Vec3, 3> x = corners(t);
      nearest2 = std::min(nearest2, closest_on_triangle(p, x[0], x[1], x[2]).distance2);
    }
    if (nearest2 > c.tolerance2(c.mesh.anchors[s.p])) return Verdict::kOffSurface;
  }
  const auto fit_of_new = [&](std::size_t k) {
    const Triangle& t = cavity.triangles[k];
    const Anchor hints[4] = {c.mesh.anchors[t.v[0]], c.mesh.anchors[t.v[1]], c.mesh.anchors[t.v[2]],
                             c.mesh.anchors[s.p]};
    return fit_triangle(c, corners(t), t.patch, hints, new_sides(s, t));
  };
  return judge_surface(cavity.triangles.size(), fit_of_new,
                       [&] { return fit_of_fan(c, s.p, cavity.removed_triangles); });
}

/// On a feature curve: the edge that bridges p stays near the curve and near p, and does not turn.
Verdict check_curve(const OperatorContext& c, const std::vector<TriangleId>& fan) {
  const Shell& s = c.shell;
  VertexId previous = kNone;
  for (TriangleId id : fan) {
    const Triangle& t = c.mesh.triangles[id];
    const int ip = index_in(t, s.p);
    for (int k = 1; k <= 2; ++k) {
      const VertexId v = t.v[(ip + 3 - k) % 3];
      if ((t.edge_tag[(ip + k) % 3] & tag::kFeature) && v != s.q) previous = v;
    }
  }
  if (previous == kNone) return Verdict::kBreaksFeature;
  const Vec3 a = c.point(previous), b = c.point(s.q), p = c.point(s.p);
  const double tolerance2 = c.tolerance2(c.mesh.anchors[s.p]);
  if (closest_on_segment(p, a, b).distance2 > tolerance2) return Verdict::kOffSurface;
  const Anchor hints[1] = {c.mesh.anchors[s.p]};
  if (c.surface.place_on_curve((a + b) / 2, hints).distance2 > tolerance2)
    return Verdict::kOffSurface;
  return Verdict::kAccept;
}

double worst_of_ball(const OperatorContext& c) {
  double worst = 1;
  for (TetId t : c.ball.tets) worst = std::min(worst, double(c.mesh.qualities[t]));
  return worst;
}

/// The ball's tets with q in place of p.
Verdict make_tets(OperatorContext& c, bool quality_gain, Cavity& cavity) {
  const Shell& s = c.shell;
  for (TetId t : c.ball.tets)
    if (c.mesh.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
  const double before = worst_of_ball(c);
  const double lowest =
      std::max(kFlat, quality_gain ? before * kQualityGain : c.lowest_allowed(before));
  for (TetId t : c.ball.tets) {
    std::array<VertexId, 4> v = c.mesh.tets[t];
    bool in_shell = false;
    for (VertexId& k : v) {
      in_shell |= k == s.q;
      if (k == s.p) k = s.q;
    }
    if (in_shell) continue;
    const double quality = c.quality(v[0], v[1], v[2], v[3]);
    if (quality < kFlat) return Verdict::kInverted;
    if (quality < lowest) return Verdict::kWorseQuality;
    cavity.tets.push_back({v, c.mesh.tet_refs[t], float(quality)});
  }
  return cavity.tets.empty() ? Verdict::kBreaksTopology : Verdict::kAccept;
}

/// How many times too long edges may become.
double tolerated_length(const OperatorContext& c, bool quality_gain) {
  if (!quality_gain) return kToleratedLong;
  return worst_of_ball(c) < kNeedle ? kNeedleLong : kRelaxedLong;
}

bool makes_long_edge(const OperatorContext& c, double longest) {
  const Shell& s = c.shell;
  return std::ranges::any_of(c.around, [&](const auto& other) {
    return other.first != s.q && c.length_exceeds(s.q, other.first, longest);
  });
}

}  // namespace

Verdict edge_collapse(OperatorContext& c, bool quality_gain, Cavity& cavity) {
  gather_ball(c.mesh, c.shell.p, c.marker, c.ball);
  gather_around(c);
  return edge_collapse_of_ball(c, quality_gain, cavity);
}

Verdict edge_collapse_of_ball(OperatorContext& c, bool quality_gain, Cavity& cavity) {
  cavity.clear();
  const Shell& s = c.shell;
  if (const Verdict v = may_merge(c); v != Verdict::kAccept) return v;
  if (c.ball.cut) return Verdict::kFrozen;
  if (makes_long_edge(c, tolerated_length(c, quality_gain) * c.limits.long_edge))
    return Verdict::kBadLength;
  if (const Verdict v = make_tets(c, quality_gain, cavity); v != Verdict::kAccept) return v;
  if (c.tags(s.p) & tag::kSurface) {
    c.fan.clear();
    for_each_triangle(c.mesh, c.ball, [&](TriangleId t) { c.fan.push_back(t); });
    if (const Verdict v = check_link(c); v != Verdict::kAccept) return v;
    make_triangles(c, c.fan, cavity);
    if (const Verdict v = check_surface(c, cavity); v != Verdict::kAccept) return v;
    if (c.tags(s.p) & tag::kOnCurve)
      if (const Verdict v = check_curve(c, c.fan); v != Verdict::kAccept) return v;
  }
  cavity.removed_tets = c.ball.tets;
  cavity.removed_vertices = {s.p};
  return Verdict::kAccept;
}

}  // namespace cavea
