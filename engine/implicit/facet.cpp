#include "cavea/implicit/facet.h"

#include <algorithm>
#include <cmath>

namespace cavea {
namespace {

/// The corners of the triangle or quadrangle, in turn.
struct Facet {
  std::array<Vec3, 4> corners;
  int count = 0;

  Vec3 middle() const {
    Vec3 sum;
    for (int k = 0; k < count; ++k) sum += corners[k];
    return sum / count;
  }
};

Facet facet_of(const LevelSet& level_set, const std::array<Vec3, 4>& corners,
               const std::array<double, 4>& values) {
  std::array<int, 4> order = {0, 1, 2, 3};
  const auto outside =
      std::ranges::stable_partition(order, [&](int k) { return values[k] < 0; }).begin();
  const int inside = int(outside - order.begin());
  Facet facet;
  const auto add = [&](int i, int j) {
    const Vec3 a = corners[order[i]], b = corners[order[j]];
    const double share = zero_on_edge(level_set, a, b, values[order[i]], values[order[j]]);
    facet.corners[facet.count++] = a + (b - a) * share;
  };
  if (inside == 2) {
    add(0, 2), add(0, 3), add(1, 3), add(1, 2);
  } else {
    const int alone = inside == 1 ? 0 : 3;
    for (int k = 0; k < 4; ++k)
      if (k != alone) add(alone, k);
  }
  return facet;
}

/// The middle of the cubic that remesh() puts over an edge whose ends have the level set's normals
/// (paper, section 3.1): its control points are a third of the edge away from the ends.
Vec3 middle_of_curve(const LevelSet& level_set, const Vec3& a, const Vec3& b) {
  const auto tangent = [&](const Vec3& p) {
    const Vec3 n = normalized(level_set.gradient(p));
    return normalized((b - a) - n * dot(b - a, n));
  };
  return (a + b) / 2 + (tangent(a) - tangent(b)) * (distance(a, b) / 8);
}

}  // namespace

bool is_crossed(const std::array<double, 4>& values) {
  return std::ranges::count_if(values, [](double x) { return x < 0; }) % 4 != 0;
}

bool is_cut_off_by(double tolerance, const LevelSet& level_set, const std::array<Vec3, 4>& corners,
                   const std::array<double, 4>& values) {
  const Facet facet = facet_of(level_set, corners, values);
  const Vec3 middle = facet.middle();
  const double most = tolerance * norm(level_set.gradient(middle));
  // Written so that a value or slope that is no number counts as off.
  const auto on = [&](const Vec3& p) { return std::abs(level_set.value(p)) <= most; };
  if (!on(middle)) return true;
  for (int k = 0; k < facet.count; ++k)
    if (!on((facet.corners[k] + facet.corners[(k + 1) % facet.count]) * 0.5)) return true;
  for (int k = 0; k < facet.count; ++k)
    if (!on(middle_of_curve(level_set, facet.corners[k], facet.corners[(k + 1) % facet.count])))
      return true;
  return false;
}

bool is_beyond(const OrientedPoint& zero, double reach, const std::array<Vec3, 4>& corners,
               const std::array<double, 4>& values) {
  for (int k = 0; k < 4; ++k) {
    const double height = dot(zero.normal, corners[k] - zero.place);
    if (std::abs(height) > reach && (height < 0) != (values[k] < 0)) return true;
  }
  return false;
}

}  // namespace cavea
