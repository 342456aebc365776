#include "cavea/surface/facet_tree.h"

#include <algorithm>

#include "cavea/base/parallel.h"
#include "cavea/geometry/closest.h"

namespace cavea {
namespace {

std::vector<Box> boxes_of(std::span<const Corners> triangles) {
  std::vector<Box> boxes(triangles.size());
  parallel_for(triangles.size(), [&](std::size_t i) { boxes[i] = box_of(triangles[i]); });
  return boxes;
}

}  // namespace

FacetTree::FacetTree(std::span<const Corners> triangles)
    : tree_(boxes_of(triangles)), triangles_(triangles.size()), slots_(tree_.slots()) {
  parallel_for(triangles.size(),
               [&](std::size_t slot) { triangles_[slot] = triangles[tree_.order()[slot]]; });
}

NearestFacet FacetTree::on(const Vec3& p, std::size_t slot) const {
  const Corners& t = triangles_[slot];
  const ClosestOnTriangle c = closest_on_triangle(p, t[0], t[1], t[2]);
  return {tree_.order()[slot], c.u, c.v, c.distance2, std::int32_t(slot)};
}

void FacetTree::improve(const Vec3& p, NearestFacet& best) const {
  double bound2 = best.distance2;
  tree_.visit_near(p, bound2, [&](std::size_t slot) {
    const NearestFacet r = on(p, slot);
    if (r.distance2 < bound2) best = r, bound2 = r.distance2;
  });
}

NearestFacet FacetTree::nearest(const Vec3& p, double bound2) const {
  NearestFacet best;
  best.distance2 = bound2;
  improve(p, best);
  if (best.facet == kNone) best = {};
  return best;
}

bool FacetTree::nearest(const PointBlock& points, const Box& box, std::int32_t hint, double reach,
                        double small, NearestOfBlock& nearest) const {
  nearest.clear(points.size());
  ClosestOfBlock closest;
  const auto look = [&](std::size_t slot) {
    const Corners& t = triangles_[slot];
    closest_on_triangle(points, t[0], t[1], t[2], closest);
    nearest.improve(closest.distance2, std::int32_t(slot));
  };
  if (hint != kNone) look(std::size_t(hint));
  if (small >= 0 && nearest.largest2() <= small * small) return false;
  const double reach2 = reach * reach;
  double bound2 = std::min(reach2, nearest.largest2());
  tree_.visit_near(box, bound2, [&](std::size_t slot) {
    if (std::int32_t(slot) == hint || box_of(triangles_[slot]).distance2(box) >= bound2) return;
    look(slot);
    bound2 = std::min(reach2, nearest.largest2());
  });
  return true;
}

NearestFacet FacetTree::hint_at(std::int32_t triangle) const {
  NearestFacet hint;
  if (triangle != kNone) hint.slot = slots_[std::size_t(triangle)];
  return hint;
}

NearestFacet FacetTree::nearest_from(const Vec3& p, const NearestFacet& hint, double small) const {
  if (hint.slot == kNone) return nearest(p);
  NearestFacet best = on(p, std::size_t(hint.slot));
  if (small < 0 || best.distance2 > small * small) improve(p, best);
  return best;
}

}  // namespace cavea
