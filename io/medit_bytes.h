#pragma once
#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cavea/io/medit_reader.h"

namespace cavea::medit {

/// The number at p, of the other byte order if Swap.
template <class T, bool Swap>
T load(const char* p) {
  char bytes[sizeof(T)];
  std::memcpy(bytes, p, sizeof(T));
  if constexpr (Swap)
    for (std::size_t k = 0; k < sizeof(T) / 2; ++k) std::swap(bytes[k], bytes[sizeof(T) - 1 - k]);
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

/// Yields the numbers of a section of a binary file. Does not look where it ends:
/// MeditBytes::blocks() has done so.
template <class Real, class Integer, bool Swap>
class ByteCursor {
 public:
  ByteCursor(std::span<const char> bytes, std::size_t at)
      : bytes_(bytes.data()), p_(bytes_ + at), last_(p_) {}

  double real() { return take<Real>(); }
  std::int64_t integer() { return take<Integer>(); }
  void skip() {}  ///< blocks begin with a row
  [[noreturn]] void fail(std::string what) const {
    throw Fault{std::size_t(last_ - bytes_), std::move(what)};
  }

 private:
  template <class T>
  T take() {
    last_ = p_;
    p_ += sizeof(T);
    return load<T, Swap>(last_);
  }

  const char *bytes_, *p_, *last_;
};

/// A Medit binary file: its sections, found and not yet read. Implements the File of
/// medit_reader.h.
class MeditBytes {
 public:
  /// `bytes` must outlive this. \throw InputError
  MeditBytes(std::span<const char> bytes, std::string name);

  const std::string& name() const { return name_; }
  const std::vector<Section>& sections() const { return sections_; }
  /// \throw InputError if the section does not hold exactly the rows that its count announces.
  std::vector<Block> blocks(const Section& s, RowLayout layout) const;
  template <class F>
  void visit(const Block& block, F&& f) const {
    swap_ ? visit_order<true>(block, f) : visit_order<false>(block, f);
  }
  std::int64_t take_small_integer(Section& s) const;
  [[noreturn]] void fail(std::size_t at, std::string_view what) const;
  [[noreturn]] void fail_whole(std::string_view what) const;

 private:
  template <bool Swap, class F>
  void visit_order(const Block& block, F&& f) const {
    if (version_ == 1) {
      ByteCursor<float, std::int32_t, Swap> cursor(bytes_, block.at);
      f(cursor);
    } else if (version_ < 4) {
      ByteCursor<double, std::int32_t, Swap> cursor(bytes_, block.at);
      f(cursor);
    } else {
      ByteCursor<double, std::int64_t, Swap> cursor(bytes_, block.at);
      f(cursor);
    }
  }
  void read_header();
  void find_sections();
  Section take_section(std::int32_t code, std::size_t at, std::size_t begin, std::size_t end) const;
  /// A number at `at`, which moves on. \throw InputError at the end of the file
  std::int64_t take(std::size_t& at, std::size_t size) const;
  std::size_t position_size() const { return version_ >= 3 ? 8 : 4; }
  std::size_t integer_size() const { return version_ >= 4 ? 8 : 4; }
  std::size_t real_size() const { return version_ == 1 ? 4 : 8; }

  std::span<const char> bytes_;
  std::string name_;
  bool swap_ = false;
  std::int32_t version_ = 0;
  std::vector<Section> sections_;
};

}  // namespace cavea::medit
