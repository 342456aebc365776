#include "cavea/partition/curve.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

struct Box {
  Vec3 low, high;
};

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Box kEmptyBox{{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};

Box join(const Box& a, const Box& b) {
  return {
      {std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y), std::min(a.low.z, b.low.z)},
      {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y), std::max(a.high.z, b.high.z)}};
}

Box bounding_box(std::span<const Vec3> points) {
  return parallel_reduce(
      points.size(), kEmptyBox,
      [&](std::size_t begin, std::size_t end) {
        Box box = kEmptyBox;
        for (std::size_t i = begin; i < end; ++i) box = join(box, {points[i], points[i]});
        return box;
      },
      join);
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

std::vector<std::int32_t> curve_order(std::span<const Vec3> points) {
  struct Entry {
    std::uint64_t key;
    std::int32_t index;
  };
  const std::vector<std::uint64_t> keys = curve_keys(points);
  std::vector<Entry> entries(points.size());
  parallel_for(entries.size(), [&](std::size_t i) {
    entries[i] = {keys[i], static_cast<std::int32_t>(i)};
  });
  parallel_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key < b.key : a.index < b.index;
  });
  std::vector<std::int32_t> order(entries.size());
  parallel_for(order.size(), [&](std::size_t k) { order[k] = entries[k].index; });
  return order;
}

}  // namespace cavea
