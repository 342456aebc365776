#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cavea/base/parallel.h"

namespace cavea {

/// Disjoint sets of the integers in [0, n), joined from many threads at once. The root of a set is
/// its smallest member, whatever the order of the joins.
class UnionFind {
 public:
  explicit UnionFind(std::size_t n) : parent_(n) {
    parallel_for(n, [&](std::size_t i) { parent_[i] = std::int32_t(i); });
  }

  void join(std::int32_t a, std::int32_t b) {
    if (parent(a) == parent(b)) return;  // as most are that are joined again
    for (;;) {
      a = root(a), b = root(b);
      if (a == b) return;
      if (a < b) std::swap(a, b);
      std::int32_t expected = a;
      // Fails if another thread has hung the root a elsewhere meanwhile.
      if (std::atomic_ref(parent_[a])
              .compare_exchange_strong(expected, b, std::memory_order_relaxed))
        return;
    }
  }

  std::int32_t root(std::int32_t a) {
    for (;;) {
      const std::int32_t p = parent(a), next = parent(p);
      if (p == next) return p;
      // Path halving: a parent only ever gets smaller, so that a lost race does no harm.
      std::int32_t expected = p;
      std::atomic_ref(parent_[a]).compare_exchange_weak(expected, next, std::memory_order_relaxed);
      a = next;
    }
  }

  bool is_root(std::int32_t a) { return parent(a) == a; }

 private:
  std::int32_t parent(std::int32_t a) {
    return std::atomic_ref(parent_[a]).load(std::memory_order_relaxed);
  }
  std::vector<std::int32_t> parent_;
};

}  // namespace cavea
