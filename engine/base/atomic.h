#pragma once
#include <atomic>

namespace cavea {

/// Adds to a number that other threads add to at the same time; for integers, whose sums do not
/// depend on the order.
template <class T>
void atomic_add(T& x, T amount) {
  std::atomic_ref<T>(x).fetch_add(amount, std::memory_order_relaxed);
}

/// Lowers `target` to `value` if that is less; safe from many threads, with a result that does not
/// depend on their order.
template <class T>
void atomic_min(T& target, T value) {
  std::atomic_ref ref(target);
  T seen = ref.load(std::memory_order_relaxed);
  while (value < seen && !ref.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
  }
}

/// Sets bits of `target`; safe from many threads.
template <class T>
void atomic_or(T& target, T bits) {
  std::atomic_ref ref(target);
  // Most calls repeat what is there already; a read does not take the cache line from the others.
  if ((ref.load(std::memory_order_relaxed) & bits) != bits)
    ref.fetch_or(bits, std::memory_order_relaxed);
}

}  // namespace cavea
