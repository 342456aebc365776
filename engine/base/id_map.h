#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cavea {

/// Numbers for ids; it is cleared in no time, and about as small as what is in it: few ids of a
/// large mesh stay in the L1 cache.
class IdMap {
 public:
  static constexpr std::int32_t kNew = -1;  ///< the number of an id that has none

  void clear() {
    used_ = 0;
    if (++epoch_ != 0) return;
    slots_.assign(slots_.size(), {});
    epoch_ = 1;
  }
  /// To read or to set; until the next one is asked for.
  std::int32_t& operator[](std::int32_t id) {
    std::size_t i = find(id);
    if (is_free(slots_[i])) {
      if (2 * ++used_ > slots_.size()) {
        grow();
        i = find(id);
      }
      slots_[i] = {epoch_, id, kNew};
    }
    return slots_[i].number;
  }
  std::int32_t at(std::int32_t id) const {
    const Slot& s = slots_[find(id)];
    return is_free(s) ? kNew : s.number;
  }

 private:
  static constexpr int kFirstBits = 8;
  struct Slot {
    std::uint32_t epoch = 0;
    std::int32_t id = 0, number = kNew;
  };

  bool is_free(const Slot& s) const { return s.epoch != epoch_; }
  /// Where the id is, or the free slot where it would be.
  std::size_t find(std::int32_t id) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = (std::uint32_t(id) * 0x9E3779B1u) >> (32 - bits_);
    while (!is_free(slots_[i]) && slots_[i].id != id) i = (i + 1) & mask;
    return i;
  }
  void grow() {
    std::vector<Slot> old(std::size_t{1} << ++bits_);
    old.swap(slots_);
    for (const Slot& s : old)
      if (!is_free(s)) slots_[find(s.id)] = s;
  }

  int bits_ = kFirstBits;
  std::vector<Slot> slots_ = std::vector<Slot>(std::size_t{1} << kFirstBits);  ///< open addressing
  std::size_t used_ = 0;
  std::uint32_t epoch_ = 1;
};

}  // namespace cavea
