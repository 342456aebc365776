#pragma once
#include <cmath>
#include <numbers>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// The angle in degrees between the two faces at the edge (a, b) of a tet (a, b, c, d).
inline double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a, n = cross(ab, c - a), m = cross(ab, d - a);
  // |n x m| = |ab| |6 volume|; the arc tangent keeps its digits near 0 and 180 degrees.
  const double sine = norm(ab) * std::abs(dot(n, d - a));
  return std::atan2(sine, dot(n, m)) * (180 / std::numbers::pi);
}

}  // namespace cavea
