#include "cavea/surface/lattice.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace cavea {

Lattice::Lattice(int n, int rows) : intervals_(n), rows_(rows) {
  places_ = {{1.0 / 3, 1.0 / 3}, {0, 0}, {0.5, 0}, {1, 0}, {0, 0.5}, {0.5, 0.5}, {0, 1}};
  const auto first = places_;
  for (int j = 0; j <= rows; ++j) {
    // As many in a row as its length asks for.
    const int count = (n * (rows - j) + rows - 1) / rows;
    for (int i = 0; i <= count; ++i) {
      const double u = count > 0 ? double(i * (rows - j)) / (count * rows) : 0;
      const Place p{u, double(j) / rows};
      const auto is_it = [&](const Place& q) { return q.u == p.u && q.v == p.v; };
      if (std::none_of(first.begin(), first.end(), is_it)) places_.push_back(p);
    }
  }
  std::vector<std::int32_t> all(places_.size());
  std::iota(all.begin(), all.end(), 0);
  divide(all, 0, all.size());
}

/// Halves what is too much for a block across its longer side.
void Lattice::divide(std::vector<std::int32_t>& places, std::size_t begin, std::size_t end) {
  if (end - begin <= PointBlock::kMost) {
    std::vector<Place> here;
    for (std::size_t i = begin; i < end; ++i) here.push_back(places_[places[i]]);
    Block& block = blocks_.emplace_back(block_of(here));
    for (std::size_t i = 0; i < block.count; ++i) block.place[i] = places[begin + i];
    return;
  }
  double low[2] = {1, 1}, high[2] = {0, 0};
  const auto coordinate = [&](std::int32_t p, int k) {
    return k == 0 ? places_[p].u : places_[p].v;
  };
  for (std::size_t i = begin; i < end; ++i)
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], coordinate(places[i], k));
      high[k] = std::max(high[k], coordinate(places[i], k));
    }
  const int k = (high[0] - low[0]) * intervals_ >= (high[1] - low[1]) * rows_ ? 0 : 1;
  const std::size_t middle = (begin + end) / 2;
  const auto first = places.begin();
  std::sort(first + std::ptrdiff_t(begin), first + std::ptrdiff_t(end),
            [&](std::int32_t a, std::int32_t b) {
              return std::tuple(coordinate(a, k), coordinate(a, 1 - k)) <
                     std::tuple(coordinate(b, k), coordinate(b, 1 - k));
            });
  divide(places, begin, middle);
  divide(places, middle, end);
}

Lattice::Block Lattice::block_of(std::span<const Place> places) {
  Block block;
  block.count = places.size();
  for (std::size_t i = 0; i < PointBlock::kMost; ++i) {
    const std::size_t p = std::min(i, places.size() - 1);
    block.place[i] = std::int32_t(p), block.u[i] = places[p].u, block.v[i] = places[p].v;
  }
  return block;
}

}  // namespace cavea
