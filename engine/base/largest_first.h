#pragma once
#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <vector>

namespace cavea {

/// The numbers in [0, n) by falling size_of(i), ties by number: the order of tasks of which the
/// last to finish is to be small.
template <class SizeOf>
std::vector<std::size_t> largest_first(std::size_t n, SizeOf&& size_of) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>{}, size_of);
  return order;
}

}  // namespace cavea
