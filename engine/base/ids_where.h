#pragma once
#include <cstdint>
#include <vector>

#include "cavea/base/parallel.h"

namespace cavea {

/// The ids of [0, n) for which is(id), ascending.
template <class Is>
std::vector<std::int32_t> ids_where(std::size_t n, Is&& is) {
  using Ids = std::vector<std::int32_t>;
  return parallel_reduce(
      n, Ids{},
      [&](std::size_t begin, std::size_t end) {
        Ids ids;
        for (std::size_t i = begin; i < end; ++i)
          if (is(std::int32_t(i))) ids.push_back(std::int32_t(i));
        return ids;
      },
      [](Ids all, const Ids& more) {
        all.insert(all.end(), more.begin(), more.end());
        return all;
      });
}

}  // namespace cavea
