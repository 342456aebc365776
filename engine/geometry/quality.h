#pragma once
#include <cmath>

#include "cavea/geometry/predicates.h"
#include "cavea/geometry/vec3.h"

namespace cavea {

/// 72 sqrt 3: makes the quality of the regular tetrahedron 1 (the paper's 144 sqrt 3, section 2,
/// gives 2).
inline constexpr double kQualityFactor = 124.70765814495915;

/// The smallest quality that counts as a tet at all. One that is above is certainly positive: six
/// times its volume is at least 4e-8 of (sum of squared edges)^(3/2), which bounds the permanent of
/// orient3d, and so tens of millions of times the rounding error (certainly_positive()).
inline constexpr double kFlat = 1e-6;

/// The paper's quality of a tetrahedron (section 2): alpha Vol / (sum of squared edges)^(3/2).
/// 1 for a regular one, 0 for a flat one, negative for an inverted one.
inline double tet_quality(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const double edges = norm2(ab) + norm2(ac) + norm2(ad) + norm2(bc) + norm2(bd) + norm2(cd);
  if (!(edges > 0)) return 0;
  const double volume = dot(ab, cross(ac, ad)) * (1.0 / 6.0);
  return kQualityFactor * volume / (edges * std::sqrt(edges));
}

/// Whether tet_quality(a, b, c, d) > limit, for limit >= 0, but for rounding: without the root and
/// the division.
inline bool quality_exceeds(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d,
                            double limit) {
  const Vec3 ab = b - a, ac = c - a, ad = d - a, bc = c - b, bd = d - b, cd = d - c;
  const double volume = (kQualityFactor / 6.0) * dot(ab, cross(ac, ad));
  const double edges = norm2(ab) + norm2(ac) + norm2(ad) + norm2(bc) + norm2(bd) + norm2(cd);
  return volume > 0 && volume * volume > (limit * limit) * (edges * edges * edges);
}

}  // namespace cavea
