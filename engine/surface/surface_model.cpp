#include "cavea/surface/surface_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cavea/base/error.h"
#include "cavea/geometry/closest.h"

namespace cavea {
namespace {

/// Fixed-point steps that move a flat projection to the nearest point of the curved patch.
constexpr int kCurvedSteps = 2;

/// Squared sine of the angle with the normal at which a place is straight below the guess: what is
/// nearest is then nearer by less than a hundredth.
constexpr double kStraightBelow = 0.0005;

double square(double x) { return x * x; }

}  // namespace

/// The snapshot's corner that an anchor stands on, or none.
std::int32_t SurfaceModel::corner_vertex(const Anchor& a) const {
  if (a.facet < 0) return kNone;
  const int k = a.u == 0 && a.v == 0 ? 0 : a.u == 1 ? 1 : a.v == 1 ? 2 : 3;
  if (k == 3) return kNone;
  const std::int32_t v = facets_[a.facet][k];
  return vertex_corner_[v] ? v : kNone;
}

template <class F>
void SurfaceModel::for_each_start(const Anchor& anchor, int patch, F&& f) const {
  if (anchor.facet == kNone) return;
  if (is_curve(anchor)) {
    const CurveEdge& c = curves_[-2 - anchor.facet];
    for (int i = 0; i < c.facet_count; ++i) {
      const std::int32_t facet = curve_facets_[c.first_facet + i];
      if (facet_patch_[facet] == patch) f(facet);
    }
    return;
  }
  if (const std::int32_t v = corner_vertex(anchor); v != kNone) {
    for (std::int32_t i = vertex_first_[v]; i < vertex_first_[v + 1]; ++i)
      if (facet_patch_[vertex_facets_[i]] == patch) f(vertex_facets_[i]);
    return;
  }
  if (facet_patch_[anchor.facet] == patch) f(anchor.facet);
}

/// The nearest point of a flat facet.
SurfaceModel::WalkResult SurfaceModel::on_facet(const Vec3& guess, std::int32_t f) const {
  const auto& k = facets_[f];
  const ClosestOnTriangle c =
      closest_on_triangle(guess, points_[k[0]], points_[k[1]], points_[k[2]]);
  return {f, c.u, c.v, c.distance2};
}

/// From a nearest point of a facet to those of others, as long as they are nearer.
SurfaceModel::WalkResult SurfaceModel::walk(const Vec3& guess, WalkResult best) const {
  auto inside_patch = [&](std::int32_t f, int k) {
    return facet_curve_[f][k] == kNone ? smooth_neighbors_[f][k] : kNone;
  };
  for (int step = 0; step < kMaxWalk; ++step) {
    WalkResult next = best;
    auto consider = [&](std::int32_t f) {
      if (f == kNone) return;
      const WalkResult r = on_facet(guess, f);
      if (r.distance2 < next.distance2) next = r;
    };
    const double w = 1 - best.u - best.v;
    // On the edge opposite corner 0, u and v are rounded and so is w.
    constexpr double kOnEdge = 1e-15;
    const bool at0 = w <= kOnEdge, at1 = best.u <= 0,
               at2 = best.v <= 0;  // on the edge opposite corner k
    if (at0) consider(inside_patch(best.facet, 0));
    if (at1) consider(inside_patch(best.facet, 1));
    if (at2) consider(inside_patch(best.facet, 2));
    if (next.facet == best.facet && at0 + at1 + at2 >= 2) {
      const int corner = !at0 ? 0 : !at1 ? 1 : 2;
      for_fan(best.facet, corner, false, consider);
    }
    if (next.facet == best.facet) break;
    best = next;
  }
  return best;
}

/// The nearest of the facets that the anchors stand on, or none of the patch.
SurfaceModel::WalkResult SurfaceModel::nearest_start(const Vec3& guess, int patch,
                                                     std::span<const Anchor> hints) const {
  WalkResult best;
  best.distance2 = kEndless;
  for (const Anchor& hint : hints)
    for_each_start(hint, patch, [&](std::int32_t facet) {
      if (facet == best.facet) return;
      const WalkResult r = on_facet(guess, facet);
      if (r.distance2 < best.distance2) best = r;
    });
  return best;
}

SurfacePoint SurfaceModel::place(const Vec3& guess, int patch, std::span<const Anchor> hints,
                                 double enough) const {
  const WalkResult start = nearest_start(guess, patch, hints);
  if (start.facet == kNone) return {{}, {}, kEndless};
  WalkResult best = walk(guess, start);
  const double enough2 = square(enough * facet_tolerance_[best.facet]);
  Vec3 x = patches_[best.facet].at(best.u, best.v);
  // Not every walk finds the nearest place.
  if (distance2(x, guess) > enough2) {
    for (const Anchor& hint : hints)
      for_each_start(hint, patch, [&](std::int32_t facet) {
        if (facet == start.facet || facet == best.facet) return;
        const WalkResult r = walk(guess, on_facet(guess, facet));
        if (r.distance2 < best.distance2) best = r;
      });
    x = patches_[best.facet].at(best.u, best.v);
  }
  Vec3 target = guess;
  for (int step = 0; step < kCurvedSteps && distance2(x, guess) > enough2; ++step) {
    // Move the flat projection by the tangential part of the error of the curved point.
    const Vec3 n = normalized(patches_[best.facet].normal(best.u, best.v));
    const Vec3 error = guess - x, aside = error - dot(error, n) * n;
    if (norm2(aside) <= kStraightBelow * norm2(error)) break;
    target += aside;
    const WalkResult r = walk(target, on_facet(target, best.facet));
    const Vec3 y = patches_[r.facet].at(r.u, r.v);
    if (distance2(y, guess) >= distance2(x, guess)) break;
    best = r;
    x = y;
  }
  return {x, {best.facet, float(best.u), float(best.v)}, distance2(x, guess)};
}

SurfacePoint SurfaceModel::place_on_curve(const Vec3& guess, std::span<const Anchor> hints) const {
  SurfacePoint result;
  result.distance2 = std::numeric_limits<double>::infinity();
  auto try_edge = [&](std::int32_t e) {
    double best = std::numeric_limits<double>::infinity();
    double best_t = 0;
    std::int32_t best_edge = e;
    auto look = [&](std::int32_t c) {
      const auto s = closest_on_segment(guess, points_[curves_[c].v[0]], points_[curves_[c].v[1]]);
      if (s.distance2 >= best) return false;
      best = s.distance2, best_t = s.t, best_edge = c;
      return true;
    };
    look(e);
    for (int side = 0; side < 2; ++side) {
      std::int32_t at = e, through = curves_[e].v[side];
      for (int step = 0; step < kMaxWalk; ++step) {
        const int end = curves_[at].v[1] == through ? 1 : 0;
        at = curves_[at].next[end];
        if (at == kNone || at == e || !look(at)) break;
        through = curves_[at].v[0] == through ? curves_[at].v[1] : curves_[at].v[0];
      }
    }
    const Vec3 x = curves_[best_edge].curve.at(best_t);
    const double d2 = distance2(x, guess);
    if (d2 < result.distance2) result = {x, {curve_anchor(best_edge), float(best_t), 0}, d2};
  };
  bool on_curve = false;
  for (const Anchor& hint : hints)
    if (is_curve(hint)) try_edge(-2 - hint.facet), on_curve = true;
  if (on_curve) return result;
  // Between two corners: the nearest of the curves that start there.
  for (const Anchor& hint : hints) {
    const std::int32_t v = corner_vertex(hint);
    if (v == kNone) continue;
    for_each_curve_at(v, try_edge);
  }
  return result;
}

Vec3 SurfaceModel::tangent(const Anchor& anchor) const {
  return normalized(curves_[-2 - anchor.facet].curve.derivative(anchor.u));
}

/// Between the normals of a facet at the ends of a curve's edge, which is one of its own.
Vec3 SurfaceModel::normal_on_curve(std::int32_t facet, const Anchor& anchor) const {
  const CurveEdge& c = curves_[-2 - anchor.facet];
  Vec3 n{};
  for (std::size_t k = 0; k < 3; ++k) {
    if (facets_[facet][k] == c.v[0]) n += (1 - anchor.u) * normals_[facet][k];
    if (facets_[facet][k] == c.v[1]) n += anchor.u * normals_[facet][k];
  }
  return n;
}

Vec3 SurfaceModel::normal(const Anchor& anchor, int patch) const {
  Vec3 n{};
  for_each_start(anchor, patch, [&](std::int32_t f) {
    if (is_curve(anchor)) {
      n += normal_on_curve(f, anchor);
    } else if (f == anchor.facet) {
      n = patches_[f].normal(anchor.u, anchor.v);
    } else if (norm2(n) == 0) {
      n = normals_[f][0] + normals_[f][1] + normals_[f][2];
    }
  });
  return normalized(n);
}

std::optional<Anchor> SurfaceModel::corner_near(const Vec3& place, double reach) const {
  const Box box = Box{place, place}.widened(reach);
  std::optional<Anchor> best;
  double best2 = reach * reach;
  curve_tree_->visit_overlapping(box, [&](std::size_t slot) {
    for (const std::int32_t v : curves_[curve_tree_->order()[slot]].v) {
      const double d2 = distance2(points_[v], place);
      if (!vertex_corner_[v] || d2 > best2) continue;
      best = anchor_of(v), best2 = d2;
    }
  });
  return best;
}

/// The anchor of a vertex of the snapshot on one of its facets.
Anchor SurfaceModel::anchor_of(std::int32_t v) const {
  const std::int32_t f = vertex_facets_[vertex_first_[v]];
  return {f, facets_[f][1] == v ? 1.0f : 0.0f, facets_[f][2] == v ? 1.0f : 0.0f};
}

double SurfaceModel::tolerance(const Anchor& anchor) const {
  return least_at(anchor, facet_tolerance_);
}

double SurfaceModel::hausd(const Anchor& anchor) const { return least_at(anchor, facet_hausd_); }

/// The least of what the facets at an anchor have.
double SurfaceModel::least_at(const Anchor& anchor, const std::vector<double>& of_facet) const {
  if (anchor.facet == kNone) return settings_.tolerance;
  if (!is_curve(anchor)) return of_facet[std::size_t(anchor.facet)];
  double least = kEndless;
  for (const std::int32_t f : facets_at_curve(curve_of(anchor.facet)))
    least = std::min(least, of_facet[std::size_t(f)]);
  return least;
}

/// The smallest tolerance that sizes follow from of the facets at a vertex.
double SurfaceModel::vertex_tolerance(std::int32_t v) const {
  double smallest = kEndless;
  for (std::int32_t i = vertex_first_[v]; i < vertex_first_[v + 1]; ++i)
    smallest = std::min(smallest, size_tolerance(vertex_facets_[i]));
  return smallest;
}

}  // namespace cavea
