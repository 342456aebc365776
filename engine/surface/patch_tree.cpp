#include "cavea/surface/patch_tree.h"

#include <algorithm>
#include <cmath>

#include "cavea/base/parallel.h"
#include "cavea/geometry/closest.h"

namespace cavea {
namespace {

/// Steps of the search on one patch. The start is off by about the angle between patch and facet,
/// and a step takes an error e to about (distance / radius of curvature) e: three are plenty.
constexpr int kMaxSteps = 4;
/// A step that gains less than this share of the squared distance ends the search: it is worth half
/// of this in the distance.
constexpr double kWorthwhile = 1e-4;

template <class F>
void for_each_control_point(const BezierTriangle& p, F&& f) {
  for (const Vec3& c : p.corner) f(c);
  for (const auto& edge : p.edge)
    for (const Vec3& c : edge) f(c);
  f(p.center);
}

std::vector<Box> boxes_of(const SurfaceModel& model) {
  std::vector<Box> boxes(model.facets());
  parallel_for(boxes.size(), [&](std::size_t f) {
    // A patch lies in the convex hull of its control points.
    for_each_control_point(model.patch_of_facet(std::int32_t(f)),
                           [&](const Vec3& c) { boxes[f].add(c); });
  });
  return boxes;
}

}  // namespace

double bulge_bound(const BezierTriangle& p) {
  double worst = 0;
  for_each_control_point(p, [&](const Vec3& c) {
    worst =
        std::max(worst, closest_on_triangle(c, p.corner[0], p.corner[1], p.corner[2]).distance2);
  });
  return std::sqrt(worst);
}

double offset_bound(const BezierTriangle& p) {
  const auto [a, b, c] = p.corner;
  double worst = distance2(p.center, (a + b + c) / 3);
  for (int k = 0; k < 3; ++k) {
    const Vec3 from = p.corner[(k + 1) % 3], third = (p.corner[(k + 2) % 3] - from) / 3;
    worst = std::max(
        {worst, distance2(p.edge[k][0], from + third), distance2(p.edge[k][1], from + 2 * third)});
  }
  return std::sqrt(worst);
}

namespace {

/// The search from one start.
NearestOnPatch search_from(const Vec3& p, const BezierTriangle& patch, double u, double v) {
  const Vec3 start = patch.at(u, v);
  NearestOnPatch best{u, v, start, distance2(start, p)};
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto [du, dv] = patch.derivatives(best.u, best.v);
    const Vec3 a = best.point - best.u * du - best.v * dv;
    const ClosestOnTriangle c = closest_on_triangle(p, a, a + du, a + dv);
    const Vec3 x = patch.at(c.u, c.v);
    const double d2 = distance2(x, p);
    if (!(d2 < best.distance2)) break;
    const bool done = d2 > (1 - kWorthwhile) * best.distance2;
    best = {c.u, c.v, x, d2};
    if (done) break;
  }
  return best;
}

}  // namespace

NearestOnPatch closest_on_patch(const Vec3& p, const BezierTriangle& patch, double u, double v) {
  NearestOnPatch best = search_from(p, patch, u, v);
  const Vec3 flat = (1 - u - v) * patch.corner[0] + u * patch.corner[1] + v * patch.corner[2];
  if (best.distance2 <= distance2(flat, p)) return best;
  // The patch should follow its facet, but where two of its edges are on one curve it is nearly
  // singular at their common corner, and the search may stall: then from elsewhere.
  constexpr double kStarts[][2] = {{1.0 / 3, 1.0 / 3}, {0.5, 0}, {0, 0.5}, {0.5, 0.5}};
  for (const auto& [s, t] : kStarts)
    if (const NearestOnPatch r = search_from(p, patch, s, t); r.distance2 < best.distance2)
      best = r;
  return best;
}

PatchTree::PatchTree(const SurfaceModel& model)
    : model_(model), tree_(boxes_of(model)), leaves_(model.facets()), slots_(tree_.slots()) {
  parallel_for(leaves_.size(), [&](std::size_t slot) {
    leaves_[slot] = {patch(slot).corner, bulge_bound(patch(slot))};
  });
}

bool PatchTree::Leaf::is_within(double reach, const Box& box) const {
  Box facet;
  for (const Vec3& p : corner) facet.add(p);
  const double by = reach + bulge;
  return facet.distance2(box) <= by * by;
}

void PatchTree::near(const Box& box, double reach, std::vector<std::int32_t>& slots) const {
  tree_.visit_overlapping(box.widened(reach), [&](std::size_t slot) {
    if (leaves_[slot].is_within(reach, box)) slots.push_back(std::int32_t(slot));
  });
}

void PatchTree::improve(const PointBlock& points, const Box& box, std::int32_t slot,
                        NearestOfBlock& nearest) const {
  const Leaf& leaf = leaves_[std::size_t(slot)];
  if (!leaf.is_within(std::sqrt(nearest.largest2()), box)) return;
  ClosestOfBlock flat;
  closest_on_triangle(points, leaf.corner[0], leaf.corner[1], leaf.corner[2], flat);
  if (!nearest.may_improve(flat.distance2, leaf.bulge)) return;
  PointBlock on;
  patch(std::size_t(slot)).at(points.size(), flat.u, flat.v, on);
  alignas(64) PointBlock::Row d2;
  for (std::size_t i = 0; i < points.groups() * PointBlock::kGroup; ++i) {
    const double x = on.x[i] - points.x[i], y = on.y[i] - points.y[i], z = on.z[i] - points.z[i];
    d2[i] = x * x + y * y + z * z;
  }
  nearest.improve(d2, slot);
}

NearestOnModel PatchTree::hint_at(std::int32_t facet) const {
  NearestOnModel hint;
  if (facet >= 0 && std::size_t(facet) < slots_.size()) hint.slot = slots_[std::size_t(facet)];
  return hint;
}

NearestOnModel PatchTree::nearest(const Vec3& p, const NearestOnModel& hint, double small) const {
  NearestOnModel best;
  double bound2 = best.place.distance2, bound = bound2;
  auto look = [&](std::size_t slot) {
    const Leaf& leaf = leaves_[slot];
    const ClosestOnTriangle flat =
        closest_on_triangle(p, leaf.corner[0], leaf.corner[1], leaf.corner[2]);
    const double reach = bound + leaf.bulge;
    if (!(flat.distance2 < reach * reach)) return;
    const NearestOnPatch r = closest_on_patch(p, patch(slot), flat.u, flat.v);
    if (!(r.distance2 < bound2)) return;
    best = {r, tree_.order()[slot], std::int32_t(slot)};
    bound2 = r.distance2, bound = std::sqrt(bound2);
  };
  if (hint.slot != kNone) look(std::size_t(hint.slot));
  if (bound <= small) return best;
  const std::int32_t seen = hint.slot;
  tree_.visit_near(p, bound2, [&](std::size_t slot) {
    if (std::int32_t(slot) != seen) look(slot);
  });
  return best;
}

}  // namespace cavea
