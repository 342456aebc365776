#pragma once
#include "cavea/geometry/vec3.h"

namespace cavea {

/// The point of a triangle nearest to a given one, as barycentric coordinates of its second and
/// third vertex, and its squared distance.
struct ClosestOnTriangle {
  double u = 0, v = 0, distance2 = 0;
};
/// Relative to its terms, below this the squared area is rounding: the triangle has none, or is so
/// far away that its sides are as near as its inside.
inline constexpr double kAreaRounding = 1e-13;
ClosestOnTriangle closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The point a + t (b - a), t in [0, 1], nearest to p.
struct ClosestOnSegment {
  double t = 0, distance2 = 0;
};
ClosestOnSegment closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b);

}  // namespace cavea
