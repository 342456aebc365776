#pragma once
#include <algorithm>
#include <cmath>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// Six times the signed volume of the tetrahedron (a, b, c, d), rounded.
inline double volume6(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(b - a, cross(c - a, d - a));
}

/// Sign of the volume of (a, b, c, d) where six times the rounded volume exceeds the bound of its
/// rounding error (Shewchuk 1997, the static filter of orient3d), and 0 elsewhere.
inline int certain_side(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  constexpr double kOrient3dErrorBound = 7.7715611723761027e-16;  // (7 + 56 u) u, u = 2^-53
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double vw = v.y * w.z, wv = v.z * w.y, vx = v.z * w.x, wx = v.x * w.z, vy = v.x * w.y,
               wy = v.y * w.x;
  const double det = u.x * (vw - wv) + u.y * (vx - wx) + u.z * (vy - wy);
  const double permanent = std::abs(u.x) * (std::abs(vw) + std::abs(wv)) +
                           std::abs(u.y) * (std::abs(vx) + std::abs(wx)) +
                           std::abs(u.z) * (std::abs(vy) + std::abs(wy));
  const double bound = kOrient3dErrorBound * permanent;
  return int(det > bound) - int(det < -bound);
}

/// Whether the volume of (a, b, c, d) is certainly positive. Never true for a flat or inverted
/// tetrahedron; may be false for one that is positive by less than the bound.
inline bool certainly_positive(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return certain_side(a, b, c, d) > 0;
}

/// Sign of the volume of (a, b, c, d): 1, 0 or -1. Filtered; where the filter fails the determinant
/// is evaluated on 113-bit floats, and 0 is returned where even their rounding may hide its sign: a
/// flat tetrahedron always gives 0, whatever the order of its vertices.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace cavea
