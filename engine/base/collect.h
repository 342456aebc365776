#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "cavea/base/parallel.h"

namespace cavea {

/// What f(i, out) appends to `out` for each i in [0, n), in the order of i; asked once for each.
template <class T, class F>
std::vector<T> collect_in_order(std::size_t n, F&& f) {
  std::vector<std::vector<T>> of_blocks((n + kReduceBlock - 1) / kReduceBlock);
  parallel_for(
      of_blocks.size(),
      [&](std::size_t b) {
        const std::size_t end = std::min(n, (b + 1) * kReduceBlock);
        for (std::size_t i = b * kReduceBlock; i < end; ++i) f(i, of_blocks[b]);
      },
      1);
  std::vector<T> all;
  for (const auto& some : of_blocks) all.insert(all.end(), some.begin(), some.end());
  return all;
}

}  // namespace cavea
