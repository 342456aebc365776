#include "cavea/geometry/length_block.h"

#include "cavea/base/wide.h"

namespace cavea {
namespace {

using Rows = const std::array<LengthBlock::Row, 4>&;

constexpr std::size_t kEnds[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

/// The bits of the edges of tet i for which is(length2, smaller size, larger size).
template <class Is>
inline std::int64_t edges_where(Rows x, Rows y, Rows z, Rows size, std::size_t i, Is&& is) {
  std::int64_t found = 0;
#pragma GCC unroll 6
  for (int e = 0; e < 6; ++e) {
    const std::size_t a = kEnds[e][0], b = kEnds[e][1];
    const double length2 = distance2({x[a][i], y[a][i], z[a][i]}, {x[b][i], y[b][i], z[b][i]});
    const bool a_less = size[a][i] < size[b][i];
    const double low = a_less ? size[a][i] : size[b][i], high = a_less ? size[b][i] : size[a][i];
    found |= is(length2, low, high) ? 1 << e : 0;
  }
  return found;
}

CAVEA_WIDE void set_perhaps_above(std::size_t n, Rows x, Rows y, Rows z, Rows size, double limit2,
                                  std::int64_t* __restrict bits) {
  for (std::size_t i = 0; i < n; ++i)
    bits[i] = edges_where(x, y, z, size, i, [&](double length2, double low, double) {
      return !(length2 <= limit2 * low * low);
    });
}

CAVEA_WIDE void set_perhaps_below(std::size_t n, Rows x, Rows y, Rows z, Rows size, double limit2,
                                  std::int64_t* __restrict bits) {
  for (std::size_t i = 0; i < n; ++i)
    bits[i] = edges_where(x, y, z, size, i, [&](double length2, double, double high) {
      return !(length2 > limit2 * high * high);
    });
}

}  // namespace

const LengthBlock::Edges& LengthBlock::pack() {
  for (std::size_t i = 0; i < count_; ++i) edges_[i] = std::uint8_t(bits_[i]);
  return edges_;
}

const LengthBlock::Edges& LengthBlock::perhaps_above(double limit) {
  set_perhaps_above(count_, x_, y_, z_, size_, limit * limit, bits_.data());
  return pack();
}

const LengthBlock::Edges& LengthBlock::perhaps_below(double limit) {
  set_perhaps_below(count_, x_, y_, z_, size_, limit * limit, bits_.data());
  return pack();
}

}  // namespace cavea
