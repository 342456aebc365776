#include "cavea/geometry/point_block.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "cavea/base/wide.h"
#include "cavea/geometry/closest.h"

namespace cavea {
namespace {

using In = const double* __restrict;
using Out = double* __restrict;

/// All bits of a condition, so that choices need no branches.
std::int64_t mask(bool condition) { return -std::int64_t(condition); }

double choose(std::int64_t mask, double a, double b) {
  return std::bit_cast<double>((std::bit_cast<std::int64_t>(a) & mask) |
                               (std::bit_cast<std::int64_t>(b) & ~mask));
}

/// The steps of closest_on_triangle() without branches: the first region that holds the point
/// counts, so they are looked at in the opposite order. \return whether some squared area is
/// rounding, so that the sides are to be asked
CAVEA_WIDE bool closest(std::size_t groups, In x, In y, In z, const Vec3& a, const Vec3& b,
                        const Vec3& c, Out u, Out v, Out distance2,
                        std::int64_t* __restrict unsure) {
  const double abx = b.x - a.x, aby = b.y - a.y, abz = b.z - a.z;
  const double acx = c.x - a.x, acy = c.y - a.y, acz = c.z - a.z;
  const double ax = a.x, ay = a.y, az = a.z, bx = b.x, by = b.y, bz = b.z;
  const double cx = c.x, cy = c.y, cz = c.z;
  std::int64_t any = 0;
  for (std::size_t i = 0; i < groups * PointBlock::kGroup; ++i) {
    const double apx = x[i] - ax, apy = y[i] - ay, apz = z[i] - az;
    const double bpx = x[i] - bx, bpy = y[i] - by, bpz = z[i] - bz;
    const double cpx = x[i] - cx, cpy = y[i] - cy, cpz = z[i] - cz;
    const double d1 = abx * apx + aby * apy + abz * apz, d2 = acx * apx + acy * apy + acz * apz;
    const double d3 = abx * bpx + aby * bpy + abz * bpz, d4 = acx * bpx + acy * bpy + acz * bpz;
    const double d5 = abx * cpx + aby * cpy + abz * cpz, d6 = acx * cpx + acy * cpy + acz * cpz;
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    const double sum = va + vb + vc;
    const double terms = std::abs(d1 * d4) + std::abs(d3 * d2) + std::abs(d5 * d2) +
                         std::abs(d1 * d6) + std::abs(d3 * d6) + std::abs(d5 * d4);
    const double d43 = d4 - d3, d56 = d5 - d6, bc = d43 + d56;
    const std::int64_t at_a = mask(d1 <= 0) & mask(d2 <= 0);
    const std::int64_t at_b = mask(d3 >= 0) & mask(d4 <= d3);
    const std::int64_t on_ab = mask(vc <= 0) & mask(d1 >= 0) & mask(d3 <= 0) & mask(d1 > d3);
    const std::int64_t at_c = mask(d6 >= 0) & mask(d5 <= d6);
    const std::int64_t on_ac = mask(vb <= 0) & mask(d2 >= 0) & mask(d6 <= 0) & mask(d2 > d6);
    const std::int64_t on_bc = mask(va <= 0) & mask(d43 >= 0) & mask(d56 >= 0);
    const std::int64_t bc_wide = mask(bc > 0);
    // u and v as fractions.
    double un = vb, ud = sum, vn = vc, vd = sum;
    un = choose(on_bc, 0, un), ud = choose(on_bc, 1, ud);
    vn = choose(on_bc, choose(bc_wide, d43, 0), vn), vd = choose(on_bc, choose(bc_wide, bc, 1), vd);
    un = choose(on_ac, 0, un), ud = choose(on_ac, 1, ud);
    vn = choose(on_ac, d2, vn), vd = choose(on_ac, d2 - d6, vd);
    un = choose(at_c, 0, un), ud = choose(at_c, 1, ud);
    vn = choose(at_c, 1, vn), vd = choose(at_c, 1, vd);
    un = choose(on_ab, d1, un), ud = choose(on_ab, d1 - d3, ud);
    vn = choose(on_ab, 0, vn), vd = choose(on_ab, 1, vd);
    un = choose(at_b, 1, un), ud = choose(at_a | at_b, 1, ud);
    vn = choose(at_b, 0, vn), vd = choose(at_a | at_b, 1, vd);
    un = choose(at_a, 0, un), vn = choose(at_a, 0, vn);
    const std::int64_t elsewhere = at_a | at_b | on_ab | at_c | on_ac;
    const double v_here = vn / vd, u_here = choose(on_bc & ~elsewhere, 1 - v_here, un / ud);
    const double qx = apx - u_here * abx - v_here * acx, qy = apy - u_here * aby - v_here * acy,
                 qz = apz - u_here * abz - v_here * acz;
    u[i] = u_here, v[i] = v_here;
    distance2[i] = qx * qx + qy * qy + qz * qz;
    unsure[i] = ~(elsewhere | on_bc) & ~mask(sum > kAreaRounding * terms);
    any |= unsure[i];
  }
  return any != 0;
}

using Maxima = std::array<double, PointBlock::kGroup>;

CAVEA_WIDE void improve_all(std::size_t groups, In found, std::int64_t number, Out distance2,
                            std::int64_t* __restrict numbers, Maxima& largest) {
  for (std::size_t i = 0; i < groups * PointBlock::kGroup; ++i) {
    const std::int64_t nearer = mask(found[i] < distance2[i]);
    distance2[i] = choose(nearer, found[i], distance2[i]);
    numbers[i] = (number & nearer) | (numbers[i] & ~nearer);
  }
  Maxima most{};
  for (std::size_t group = 0; group < groups; ++group)
    for (std::size_t k = 0; k < PointBlock::kGroup; ++k) {
      const double d2 = distance2[group * PointBlock::kGroup + k];
      most[k] = d2 > most[k] ? d2 : most[k];
    }
  largest = most;
}

}  // namespace

void NearestOfBlock::improve(const PointBlock::Row& found, std::int32_t number) {
  Maxima largest;
  improve_all(groups_, found.data(), number, distance2_.data(), number_.data(), largest);
  largest2_ = *std::max_element(largest.begin(), largest.end());
}

bool NearestOfBlock::may_improve(const PointBlock::Row& found, double slack) const {
  for (std::size_t i = 0; i < groups_ * PointBlock::kGroup; ++i)
    if (std::sqrt(found[i]) - slack < std::sqrt(distance2_[i])) return true;
  return false;
}

void closest_on_triangle(const PointBlock& points, const Vec3& a, const Vec3& b, const Vec3& c,
                         ClosestOfBlock& result) {
  alignas(64) std::array<std::int64_t, PointBlock::kMost> unsure;
  if (!closest(points.groups(), points.x.data(), points.y.data(), points.z.data(), a, b, c,
               result.u.data(), result.v.data(), result.distance2.data(), unsure.data()))
    return;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (unsure[i] == 0) continue;
    const ClosestOnTriangle r = closest_on_triangle(points[i], a, b, c);
    result.u[i] = r.u, result.v[i] = r.v, result.distance2[i] = r.distance2;
  }
}

}  // namespace cavea
