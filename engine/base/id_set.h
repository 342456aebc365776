#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace cavea {

/// A growing set of ids, which are not negative: an open hash table, for few ids out of many.
class IdSet {
 public:
  /// Whether the id was not there before.
  bool insert(std::int32_t id) {
    if (2 * (size_ + 1) > table_.size()) grow();
    std::int32_t& at = table_[place_of(id)];
    if (at == id) return false;
    at = id;
    ++size_;
    return true;
  }

 private:
  static constexpr std::int32_t kEmpty = -1;
  static constexpr std::size_t kFirstSize = 64;

  /// Where the id is, or is to be.
  std::size_t place_of(std::int32_t id) const {
    constexpr std::uint32_t kGolden = 0x9e3779b9u;  // scatters consecutive ids (Knuth 6.4)
    const int bits = std::countr_zero(table_.size());
    std::size_t k = (std::uint32_t(id) * kGolden) >> (32 - bits);
    while (table_[k] != id && table_[k] != kEmpty) k = (k + 1) & (table_.size() - 1);
    return k;
  }

  void grow() {
    std::vector<std::int32_t> old(table_.empty() ? kFirstSize : 2 * table_.size(), kEmpty);
    std::swap(old, table_);
    for (const std::int32_t id : old)
      if (id != kEmpty) table_[place_of(id)] = id;
  }

  std::vector<std::int32_t> table_;
  std::size_t size_ = 0;
};

}  // namespace cavea
