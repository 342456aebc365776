#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "cavea/base/parallel.h"

namespace cavea {

/// The ids of [0, n) for which is(id), ascending. It is asked twice for each.
template <class Is>
std::vector<std::int32_t> ids_where(std::size_t n, Is&& is) {
  const auto for_each_in = [&](std::size_t block, auto&& f) {
    const std::size_t end = std::min(n, (block + 1) * kReduceBlock);
    for (std::size_t i = block * kReduceBlock; i < end; ++i)
      if (is(std::int32_t(i))) f(std::int32_t(i));
  };
  std::vector<std::size_t> next((n + kReduceBlock - 1) / kReduceBlock, 0);
  parallel_for(
      next.size(), [&](std::size_t b) { for_each_in(b, [&](std::int32_t) { ++next[b]; }); }, 1);
  std::vector<std::int32_t> ids(exclusive_scan(next));
  parallel_for(
      next.size(),
      [&](std::size_t b) {
        std::int32_t* to = ids.data() + next[b];
        for_each_in(b, [&](std::int32_t id) { *to++ = id; });
      },
      1);
  return ids;
}

/// How many of [0, n) there are for which is(id).
template <class Is>
std::int64_t count_where(std::size_t n, Is&& is) {
  return parallel_reduce(
      n, std::int64_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::int64_t count = 0;
        for (std::size_t i = begin; i < end; ++i) count += bool(is(std::int32_t(i)));
        return count;
      },
      std::plus<>{});
}

}  // namespace cavea
