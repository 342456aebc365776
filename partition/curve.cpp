#include "cavea/partition/curve.h"

#include <algorithm>
#include <cmath>

#include "cavea/base/parallel.h"
#include "cavea/geometry/box.h"

namespace cavea {
namespace {

Box bounding_box(std::span<const Vec3> points) {
  return parallel_reduce(
      points.size(), Box{},
      [&](std::size_t begin, std::size_t end) {
        Box box;
        for (std::size_t i = begin; i < end; ++i) box.add(points[i]);
        return box;
      },
      [](Box a, const Box& b) {
        a.add(b);
        return a;
      });
}

/// Puts two zero bits before each of the 21 low bits (magic masks of the "bit twiddling hacks").
std::uint64_t spread(std::uint64_t b) {
  b = (b | b << 32) & 0x001f00000000ffff;
  b = (b | b << 16) & 0x001f0000ff0000ff;
  b = (b | b << 8) & 0x100f00f00f00f00f;
  b = (b | b << 4) & 0x10c30c30c30c30c3;
  b = (b | b << 2) & 0x1249249249249249;
  return b;
}

/// The cell of a coordinate at the deepest level; written so that a NaN gives 0.
std::uint64_t cell(double x, double low, double scale) {
  constexpr double kLast = (1 << kCurveLevels) - 1;
  const double t = (x - low) * scale;
  return t > 0 ? static_cast<std::uint64_t>(std::min(t, kLast)) : 0;
}

}  // namespace

std::vector<std::uint64_t> curve_keys(std::span<const Vec3> points) {
  const Box box = bounding_box(points);
  const Vec3 extent = box.high - box.low;
  const double side = std::max({extent.x, extent.y, extent.z});
  const double scale = side > 0 ? double(1 << kCurveLevels) / side : 0;
  std::vector<std::uint64_t> keys(points.size());
  parallel_for(points.size(), [&](std::size_t i) {
    const Vec3& p = points[i];
    keys[i] = spread(cell(p.x, box.low.x, scale)) << 2 | spread(cell(p.y, box.low.y, scale)) << 1 |
              spread(cell(p.z, box.low.z, scale));
  });
  return keys;
}

}  // namespace cavea
