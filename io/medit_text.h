#pragma once
#include <charconv>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "cavea/io/medit_reader.h"
#include "cavea/io/text_scan.h"

namespace cavea::medit {

/// Yields the numbers of a section of a text, one after the other.
class TokenCursor {
 public:
  TokenCursor(std::string_view text, std::size_t begin, std::size_t end)
      : text_(text.data()), p_(text_ + begin), token_(p_), end_(text_ + end) {}

  double real() {
    advance();
    double value;
    const auto [stop, error] = std::from_chars(p_, end_, value);
    if (error != std::errc() || !ends_token(stop)) return unusual_real();
    p_ = stop;
    return value;
  }
  std::int64_t integer() {
    advance();
    std::int64_t value;
    const char* first = *p_ == '+' && p_ + 1 < end_ && p_[1] != '-' ? p_ + 1 : p_;
    const auto [stop, error] = std::from_chars(first, end_, value);
    if (error != std::errc() || !ends_token(stop)) refuse("a whole number");
    p_ = stop;
    return value;
  }
  void skip() {
    advance();
    while (!ends_token(p_)) ++p_;
  }
  std::size_t offset() const { return std::size_t(p_ - text_); }
  [[noreturn]] void fail(std::string what) const {
    throw Fault{std::size_t(token_ - text_), std::move(what)};
  }

 private:
  bool ends_token(const char* p) const { return p == end_ || is_space(*p); }
  void advance() {
    while (p_ < end_ && is_space(*p_)) ++p_;
    token_ = p_;
    if (p_ == end_) fail("a number is due here");
  }
  /// A number with a plus sign or the exponent letter D of Fortran, one outside of the range of
  /// doubles, or no number.
  double unusual_real();
  [[noreturn]] void refuse(std::string_view due) const;

  const char* text_;
  const char* p_;
  const char* token_;  ///< where the number that was asked for last begins
  const char* end_;
};

/// A Medit ASCII file: its sections, found and not yet read. Implements the File of medit_reader.h.
class MeditText {
 public:
  /// Blanks the comments in `text`, which must outlive this. \throw InputError
  MeditText(std::span<char> text, std::string name);

  const std::string& name() const { return name_; }
  const std::vector<Section>& sections() const { return sections_; }
  /// \throw InputError if the section does not hold exactly the numbers that its count announces.
  std::vector<Block> blocks(const Section& s, RowLayout layout) const;
  template <class F>
  void visit(const Block& block, F&& f) const {
    TokenCursor cursor(text_, block.at, block.end);
    f(cursor);
  }
  std::int64_t take_small_integer(Section& s) const;
  [[noreturn]] void fail(std::size_t at, std::string_view what) const;
  [[noreturn]] void fail_whole(std::string_view what) const;

 private:
  void find_sections(const std::vector<std::string_view>& words);
  Section make_section(std::string_view word, std::size_t end) const;
  void check_header(Section s, int smallest, int largest) const;
  [[noreturn]] void fail_count(const Section& s, std::size_t width, std::size_t found) const;
  std::string describe_odd_line(const Section& s, std::size_t width) const;

  std::string_view text_;
  std::string name_;
  std::vector<Section> sections_;
};

}  // namespace cavea::medit
