#pragma once
#include <algorithm>
#include <vector>

namespace cavea {

/// Sorts, and keeps one of those that are the same.
template <class T>
void keep_once(std::vector<T>& all) {
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
}

template <class T>
bool is_in(const std::vector<T>& sorted, const T& item) {
  return std::ranges::binary_search(sorted, item);
}

}  // namespace cavea
