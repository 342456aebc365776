#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "cavea/base/parallel.h"

namespace cavea {

/// Values grouped by an integer key: a parallel counting sort, the substitute for a hash table of
/// faces or edges. Which values are in a bucket depends on the data alone; their order in it does
/// not, so that whoever reads a bucket first sorts it.
class Buckets {
 public:
  Buckets() = default;

  /// Calls emit(item, put) twice for each item in [0, items); emit calls put(key, value) for each
  /// value of the item, keys in [0, keys), the same ones both times. Fewer than 2^32 values.
  template <class Emit>
  Buckets(std::size_t items, std::size_t keys, Emit&& emit) : ends_(keys, 0) {
    parallel_for(items,
                 [&](std::size_t i) { emit(i, [&](auto key, std::uint32_t) { next(key); }); });
    size_ = exclusive_scan(ends_);
    // Unset: all threads touch the new memory as they fill it, in place of one that clears it.
    values_ = std::make_unique_for_overwrite<std::uint32_t[]>(size_);
    // Each cursor starts at the begin of its bucket and stops at its end.
    parallel_for(items, [&](std::size_t i) {
      emit(i, [&](auto key, std::uint32_t value) { values_[next(key)] = value; });
    });
  }

  std::size_t keys() const { return ends_.size(); }
  std::size_t size() const { return size_; }
  std::size_t begin_of(std::size_t key) const { return key == 0 ? 0 : ends_[key - 1]; }
  std::size_t end_of(std::size_t key) const { return ends_[key]; }
  std::uint32_t operator[](std::size_t slot) const { return values_[slot]; }

  std::span<std::uint32_t> of(std::size_t key) {
    return {values_.get() + begin_of(key), end_of(key) - begin_of(key)};
  }
  std::span<const std::uint32_t> of(std::size_t key) const {
    return {values_.get() + begin_of(key), end_of(key) - begin_of(key)};
  }

 private:
  template <class Key>
  std::uint32_t next(Key key) {
    return std::atomic_ref(ends_[static_cast<std::size_t>(key)])
        .fetch_add(1, std::memory_order_relaxed);
  }

  std::vector<std::uint32_t> ends_;
  std::unique_ptr<std::uint32_t[]> values_;
  std::size_t size_ = 0;
};

/// Each value of a bucket once, rising: the bucket's beginning. Its end is left in disorder.
inline std::span<std::uint32_t> rising_once(std::span<std::uint32_t> values) {
  // Most buckets repeat few values many times, so that looking for each among those is sooner than
  // sorting them all; a vertex of thousands of edges has too many for that.
  constexpr std::size_t kMany = 128;
  std::size_t different = 0;
  if (values.size() > kMany) {
    std::ranges::sort(values);
    different = std::size_t(std::unique(values.begin(), values.end()) - values.begin());
  } else {
    for (const std::uint32_t value : values) {
      const auto last = values.begin() + std::ptrdiff_t(different);
      if (std::find(values.begin(), last, value) == last) values[different++] = value;
    }
    std::ranges::sort(values.first(different));
  }
  return values.first(different);
}

}  // namespace cavea
