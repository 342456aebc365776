#include "cavea/operator/relocate.h"

#include <bit>
#include <cmath>
#include <optional>

#include "cavea/base/scatter.h"
#include "cavea/operator/pattern_search.h"

namespace cavea {
namespace {

/// Shares of the way to the target that are tried in turn.
constexpr double kShares[] = {1, 0.5, 0.2};
/// Balls with a worse tet than this are also tried for its sake alone.
constexpr double kBadBall = 0.5;
/// In other balls a target that is nearer than this, in wanted sizes, is not worth a trial: 1% of
/// those below 0.025 succeed, a tenth of those below 0.05, nine tenths of those beyond 0.25.
constexpr double kStill = 0.03;
/// The mean quality of a ball must rise by this much where the worst does not.
constexpr double kMeanGain = 0.002;

struct BallQuality {
  double worst = 1, sum = 0;
};

/// Mean, weighted towards bad tets, of the places of the vertex that would make each tet of its
/// ball as regular as its face opposite allows.
Vec3 ideal_place(const OperatorContext& c) {
  constexpr float kWorstCounted = 0.05f;  // bounds the weight of a bad tet
  Vec3 sum{};
  double weights = 0;
  for (std::size_t i = 0; i < c.ball.tets.size(); ++i) {
    const double q = std::max(kWorstCounted, c.mesh.qualities[c.ball.tets[i]]);
    const double w = 1 / (q * q);
    sum += w * c.star.ideal_apex(i);
    weights += w;
  }
  return sum / weights;
}

/// The same for the worst tet of the ball alone.
Vec3 ideal_for_worst(const OperatorContext& c) {
  std::size_t worst = 0;
  for (std::size_t i = 1; i < c.ball.tets.size(); ++i)
    if (c.mesh.qualities[c.ball.tets[i]] < c.mesh.qualities[c.ball.tets[worst]]) worst = i;
  return c.star.ideal_apex(worst);
}

BallQuality now(const OperatorContext& c) {
  BallQuality b;
  for (TetId t : c.ball.tets) {
    b.worst = std::min(b.worst, double(c.mesh.qualities[t]));
    b.sum += c.mesh.qualities[t];
  }
  return b;
}

/// Qualities of the ball with its vertex at x; false if one is below `lowest` or flat.
bool evaluate(OperatorContext& c, const Vec3& x, double lowest, BallQuality& b) {
  b = {};
  c.star.evaluate(x);
  const double* q = c.star.qualities();
  for (std::size_t i = 0; i < c.star.size(); ++i) {
    b.worst = std::min(b.worst, q[i]);
    b.sum += q[i];
  }
  return b.worst >= std::max(lowest, kFlat);
}

/// The qualities of the last evaluation as the mesh keeps them.
void keep_qualities(OperatorContext& c) {
  c.qualities.assign(c.star.qualities(), c.star.qualities() + c.star.size());
}

bool better(const BallQuality& a, const BallQuality& b, std::size_t tets) {
  return a.worst > b.worst * kQualityGain || a.sum > b.sum + kMeanGain * double(tets);
}

/// Whether the ball is better with its vertex at x.
bool gains(OperatorContext& c, const Vec3& x, const BallQuality& before) {
  BallQuality after;
  return evaluate(c, x, before.worst, after) && better(after, before, c.ball.tets.size());
}

/// The two neighbours of a feature vertex on its curve.
bool curve_neighbors(const OperatorContext& c, VertexId v, std::array<VertexId, 2>& ends) {
  int n = 0;
  ends = {kNone, kNone};
  for (TriangleId id : c.fan) {
    const Triangle& t = c.mesh.triangles[id];
    for (int k = 0; k < 3; ++k) {
      if (t.v[k] == v || !(t.edge_tag[k] & tag::kFeature)) continue;
      const VertexId end = t.v[(k + 1) % 3] == v ? t.v[(k + 2) % 3] : t.v[(k + 1) % 3];
      if (end == ends[0] || end == ends[1]) continue;
      if (n == 2) return false;
      ends[n++] = end;
    }
  }
  return n == 2;
}

/// Judges places for the vertex of a fan.
class FanJudge {
 public:
  FanJudge(const OperatorContext& c, VertexId v) : c_(c), v_(v) {}

  Verdict operator()(const NewVertex& to) {
    return judge_surface(
        c_.fan.size(),
        [&](std::size_t k) { return fit_in_fan(c_, c_.fan[k], v_, to.point, to.anchor); },
        [&] { return as_it_is(); });
  }

 private:
  /// Asked for once, for all places that do not fit.
  const SurfaceFit& as_it_is() {
    if (!as_it_is_) as_it_is_ = fit_of_fan(c_, v_, c_.fan);
    return *as_it_is_;
  }

  const OperatorContext& c_;
  VertexId v_;
  std::optional<SurfaceFit> as_it_is_;
};

/// Where a surface vertex goes for a wished place: onto its curve or its patch.
SurfacePoint on_surface(const OperatorContext& c, VertexId v, const Vec3& wish) {
  const Anchor hints[1] = {c.mesh.anchors[v]};
  if (c.tags(v) & tag::kOnCurve) return c.surface.place_on_curve(wish, hints);
  return c.surface.place(wish, c.mesh.triangles[c.fan[0]].patch, hints);
}

/// A way along the surface triangles at a vertex: what leads off them is undone by on_surface().
Vec3 along_fan(const OperatorContext& c, const Vec3& way) {
  Vec3 normal{};
  for (TriangleId id : c.fan) {
    const auto& t = c.mesh.triangles[id].v;
    const Vec3 n = cross(c.point(t[1]) - c.point(t[0]), c.point(t[2]) - c.point(t[0]));
    normal += dot(n, normal) < 0 ? -1.0 * n : n;  // those of sheets need not be oriented alike
  }
  const double square = norm2(normal);
  return square > 0 ? way - dot(way, normal) / square * normal : way;
}

Vec3 surface_target(const OperatorContext& c, VertexId v) {
  std::array<VertexId, 2> ends;
  if ((c.tags(v) & tag::kOnCurve) && curve_neighbors(c, v, ends))
    return (c.point(ends[0]) + c.point(ends[1])) / 2;
  // Half way between what the surface and what the volume would like.
  Vec3 sum{};
  for (TriangleId id : c.fan)
    for (VertexId k : c.mesh.triangles[id].v)
      if (k != v) sum += c.point(k);
  const Vec3 target = (sum / (2.0 * double(c.fan.size())) + ideal_place(c)) / 2;
  return c.point(v) + along_fan(c, target - c.point(v));
}

/// The same as climb() for a surface vertex: every place tried is on the surface.
Verdict climb_on_surface(OperatorContext& c, VertexId v, const BallQuality& before, FanJudge& judge,
                         NewVertex& to) {
  constexpr double kFirstStep = 0.15;
  // The way down to the surface is short, and changes qualities little.
  constexpr double kHopeless = 0.5;
  double best = before.worst;
  BallQuality after;
  const Vec3 x =
      pattern_search(c.point(v), kFirstStep * to.size, best, [&](const Vec3& y, double limit) {
        if (!evaluate(c, y, kHopeless * limit, after)) return limit;
        const SurfacePoint at = on_surface(c, v, y);
        if (at.anchor.facet == kNone || !evaluate(c, at.point, limit, after)) return limit;
        return after.worst;
      });
  if (best <= kQualityGain * before.worst) return Verdict::kWorseQuality;
  const SurfacePoint at = on_surface(c, v, x);
  to.point = at.point;
  to.anchor = at.anchor;
  if (!evaluate(c, to.point, before.worst, after)) return Verdict::kWorseQuality;
  return judge(to);
}

/// Whether a vertex is so near its target that its ball would hardly gain.
bool stands_still(const Vec3& target, const BallQuality& before, const NewVertex& now) {
  const double near = kStill * now.size;
  return before.worst >= kBadBall && distance2(target, now.point) < near * near;
}

/// Whether no tet is made too bad by a move that is needed.
bool is_allowed(OperatorContext& c, const Vec3& x, const BallQuality& before) {
  BallQuality after;
  return evaluate(c, x, std::max(kFlat, c.lowest_allowed(before.worst)), after);
}

Verdict relocate_on_surface(OperatorContext& c, VertexId v, NewVertex& to) {
  c.fan.clear();
  for_each_triangle(c.mesh, c.ball, [&](TriangleId t) { c.fan.push_back(t); });
  if (c.fan.empty()) return Verdict::kBreaksFeature;
  for (TriangleId t : c.fan)
    if (c.mesh.triangles[t].tags & tag::kRequired) return Verdict::kBreaksFeature;
  std::array<VertexId, 2> ends;
  if ((c.tags(v) & tag::kOnCurve) && !curve_neighbors(c, v, ends)) return Verdict::kBreaksFeature;
  const BallQuality before = now(c);
  const bool off = c.tags(v) & tag::kOffSurface;
  const Vec3 from = c.point(v), target = off ? from : surface_target(c, v);
  if (!off && stands_still(target, before, to)) return Verdict::kNotNeeded;
  FanJudge judge(c, v);
  Verdict why = Verdict::kWorseQuality;
  for (const double share : kShares) {
    const Vec3 wish = from + share * (target - from);
    // The way down to the surface is short: of wishes without a gain one in 60 has one there.
    if (!off && !gains(c, wish, before)) continue;
    const SurfacePoint at = on_surface(c, v, wish);
    if (at.anchor.facet == kNone) return Verdict::kOffSurface;
    to.point = off ? from + share * (at.point - from) : at.point;
    to.anchor = at.anchor;
    // A vertex that is not on the surface yet goes there if the tets allow; others must gain.
    if (off ? !is_allowed(c, to.point, before) : !gains(c, to.point, before)) continue;
    if (why = judge(to); why != Verdict::kAccept) continue;
    if (off && share == 1) to.tags &= Tag(~tag::kOffSurface);
    return Verdict::kAccept;
  }
  if (off || before.worst >= kBadBall) return why;
  return climb_on_surface(c, v, before, judge, to);
}

bool move_towards(OperatorContext& c, VertexId v, const Vec3& target, const BallQuality& before,
                  NewVertex& to) {
  const Vec3 from = c.point(v);
  for (const double share : kShares) {
    to.point = from + share * (target - from);
    if (gains(c, to.point, before)) return true;
  }
  return false;
}

/// Searches for a place where the worst quality of the ball is larger.
bool climb(OperatorContext& c, VertexId v, const BallQuality& before, NewVertex& to) {
  // First step in wanted sizes.
  constexpr double kFirstStep = 0.2;
  double best = before.worst;
  BallQuality after;
  const Vec3 from = c.point(v);
  to.point = pattern_search(from, kFirstStep * to.size, best, [&](const Vec3& x, double limit) {
    return evaluate(c, x, limit, after) ? after.worst : limit;
  });
  return best > kQualityGain * before.worst && evaluate(c, to.point, before.worst, after);
}

Verdict relocate_inside(OperatorContext& c, VertexId v, NewVertex& to) {
  const BallQuality before = now(c);
  const Vec3 target = ideal_place(c);
  if (stands_still(target, before, to)) return Verdict::kNotNeeded;
  if (move_towards(c, v, target, before, to)) return Verdict::kAccept;
  if (before.worst >= kBadBall) return Verdict::kWorseQuality;
  if (move_towards(c, v, ideal_for_worst(c), before, to)) return Verdict::kAccept;
  return climb(c, v, before, to) ? Verdict::kAccept : Verdict::kWorseQuality;
}

/// A unit vector that looks random and depends on the bits of a place.
Vec3 direction_of(const Vec3& p) {
  std::uint64_t h = kScatterStart;
  for (const double x : {p.x, p.y, p.z}) h = scatter(h + std::bit_cast<std::uint64_t>(x));
  auto next = [&] { return double((h = scatter(h + 1)) >> 11) * 0x1p-52 - 1; };
  Vec3 d;
  d.x = next(), d.y = next(), d.z = next();
  return normalized(d);
}

}  // namespace

Verdict relocate(OperatorContext& c, VertexId v, NewVertex& to) {
  gather_ball(c.mesh, v, c.marker, c.ball);
  return relocate_in_ball(c, v, to);
}

Verdict relocate_in_ball(OperatorContext& c, VertexId v, NewVertex& to) {
  const Tag tags = c.tags(v);
  if (tags & tag::kFrozen) return Verdict::kFrozen;
  if (tags & (tag::kCorner | tag::kRequired)) return Verdict::kBreaksFeature;
  if ((tags & tag::kSurface) && c.limits.surface_frozen) return Verdict::kBreaksFeature;
  if (tags & tag::kPinched) return Verdict::kBreaksTopology;
  if (c.ball.cut) return Verdict::kFrozen;
  prepare_star(c);
  to = {c.point(v), c.mesh.sizes[v], tags, c.mesh.vertex_refs[v], c.mesh.anchors[v]};
  const Verdict verdict =
      tags & tag::kSurface ? relocate_on_surface(c, v, to) : relocate_inside(c, v, to);
  if (verdict == Verdict::kAccept) keep_qualities(c);
  return verdict;
}

Verdict shake(OperatorContext& c, VertexId v, double below, double floor, NewVertex& to) {
  constexpr double kStep = 0.2;  // of the wanted size
  const Tag tags = c.tags(v);
  if (tags & (tag::kFrozen | tag::kSurface | tag::kCorner | tag::kRequired))
    return Verdict::kFrozen;
  if (now(c).sum > below * double(c.ball.tets.size())) return Verdict::kNotNeeded;
  prepare_star(c);
  to = {c.point(v), c.mesh.sizes[v], tags, c.mesh.vertex_refs[v], c.mesh.anchors[v]};
  to.point += kStep * to.size * direction_of(to.point);
  BallQuality after;
  if (!evaluate(c, to.point, floor, after)) return Verdict::kWorseQuality;
  keep_qualities(c);
  return Verdict::kAccept;
}

}  // namespace cavea
