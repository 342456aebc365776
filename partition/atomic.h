#pragma once
#include <atomic>

namespace cavea {

/// Adds to a number that other threads add to at the same time; for integers, whose sums do not
/// depend on the order. Returns the value before.
template <class T>
T atomic_add(T& x, T amount) {
  return std::atomic_ref<T>(x).fetch_add(amount, std::memory_order_relaxed);
}

}  // namespace cavea
