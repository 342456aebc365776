#include "cavea/geometry/closest.h"

#include <algorithm>
#include <cmath>

namespace cavea {
namespace {

ClosestOnTriangle closest_on_sides(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const ClosestOnSegment ab = closest_on_segment(p, a, b), ac = closest_on_segment(p, a, c),
                         bc = closest_on_segment(p, b, c);
  if (ab.distance2 <= ac.distance2 && ab.distance2 <= bc.distance2) return {ab.t, 0, ab.distance2};
  if (ac.distance2 <= bc.distance2) return {0, ac.t, ac.distance2};
  return {1 - bc.t, bc.t, bc.distance2};
}

}  // namespace

// Regions of the triangle as in Ericson, Real-Time Collision Detection, section 5.1.5.
ClosestOnTriangle closest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  auto result = [&](double u, double v) {
    return ClosestOnTriangle{u, v, norm2(ap - u * ab - v * ac)};
  };
  const double d1 = dot(ab, ap), d2 = dot(ac, ap), d3 = dot(ab, bp), d4 = dot(ac, bp),
               d5 = dot(ab, cp), d6 = dot(ac, cp);
  const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
  const bool at_a = (d1 <= 0) & (d2 <= 0), at_b = (d3 >= 0) & (d4 <= d3),
             at_c = (d6 >= 0) & (d5 <= d6);
  // One question for the most frequent answer: wrong guesses of the processor cost more than terms.
  const bool inside = (va > 0) & (vb > 0) & (vc > 0) & !(at_a | at_b | at_c);
  if (!inside) {
    if (at_a) return result(0, 0);
    if (at_b) return result(1, 0);
    if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return result(d1 / (d1 - d3), 0);
    if (at_c) return result(0, 1);
    if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return result(0, d2 / (d2 - d6));
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
      const double sum = (d4 - d3) + (d5 - d6), w = sum > 0 ? (d4 - d3) / sum : 0;
      return result(1 - w, w);
    }
  }
  const double sum = va + vb + vc;
  const double terms = std::abs(d1 * d4) + std::abs(d3 * d2) + std::abs(d5 * d2) +
                       std::abs(d1 * d6) + std::abs(d3 * d6) + std::abs(d5 * d4);
  if (!(sum > kAreaRounding * terms)) return closest_on_sides(p, a, b, c);
  return result(vb / sum, vc / sum);
}

ClosestOnSegment closest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length2 = norm2(ab);
  const double t = length2 > 0 ? std::clamp(dot(p - a, ab) / length2, 0.0, 1.0) : 0;
  return {t, norm2(p - a - t * ab)};
}

}  // namespace cavea
