#include "cavea/io/text_scan.h"

#include <algorithm>
#include <cstring>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

constexpr std::size_t kScanBytes = std::size_t{1} << 20;  // enough to outweigh starting a task
constexpr std::size_t kPrintedToken = 40;

constexpr bool is_letter(char c) { return static_cast<unsigned char>((c | 0x20) - 'a') < 26; }

/// Whether the bytes hold anything but numbers and space. Without a branch in the loop, so that the
/// compiler makes vector code of it: most of a mesh passes here and nowhere else.
bool has_letter_or_comment(const char* p, std::size_t n) {
  bool found = false;
  for (std::size_t i = 0; i < n; ++i) found |= is_letter(p[i]) | (p[i] == '#');
  return found;
}

/// nan and inf are numbers, if bad ones: the message should say so.
bool spells_number(std::string_view word) {
  std::string lower(word.substr(0, 9));
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) { return char(c | 0x20); });
  return lower == "nan" || lower == "inf" || lower == "infinity";
}

/// Scans whole lines; see scan_words().
class LineScanner {
 public:
  LineScanner(char* begin, char* end) : begin_(begin), p_(begin), end_(end) {}

  std::vector<std::string_view> words() {
    constexpr std::size_t kStride = 64;
    while (p_ < end_) {
      const std::size_t n = std::min<std::size_t>(kStride, end_ - p_);
      if (has_letter_or_comment(p_, n))
        scan(p_ + n);
      else
        p_ += n;
    }
    return std::move(words_);
  }

 private:
  void scan(const char* stop) {
    while (p_ < stop) {
      if (*p_ == '#')
        blank_comment();
      else if (is_letter(*p_) && (p_ == begin_ || is_space(p_[-1])))
        take_word();
      else
        ++p_;
    }
  }
  void blank_comment() {
    while (p_ < end_ && *p_ != '\n') *p_++ = ' ';
  }
  void take_word() {
    const char* first = p_;
    while (p_ < end_ && !is_space(*p_) && *p_ != '#') ++p_;
    const std::string_view word(first, p_ - first);
    if (!spells_number(word)) words_.push_back(word);
  }

  char *begin_, *p_, *end_;
  std::vector<std::string_view> words_;
};

/// The offsets at which to cut the text into pieces of about `size` bytes, each just behind a byte
/// that may be cut after.
template <class MayCutAfter>
std::vector<std::size_t> cut(std::string_view text, std::size_t size, MayCutAfter&& may_cut_after) {
  std::vector<std::size_t> cuts = {0};
  while (text.size() - cuts.back() > size) {
    std::size_t at = cuts.back() + size;
    while (at < text.size() && !may_cut_after(text[at - 1])) ++at;
    cuts.push_back(at);
  }
  if (cuts.back() < text.size() || cuts.size() == 1) cuts.push_back(text.size());
  return cuts;
}

}  // namespace

std::vector<std::string_view> scan_words(std::span<char> text) {
  const std::vector<std::size_t> cuts =
      cut({text.data(), text.size()}, kScanBytes, [](char c) { return c == '\n'; });
  std::vector<std::vector<std::string_view>> found(cuts.size() - 1);
  parallel_tasks(found.size(), [&](std::size_t k) {
    found[k] = LineScanner(text.data() + cuts[k], text.data() + cuts[k + 1]).words();
  });
  std::vector<std::string_view> all;
  for (const auto& words : found) all.insert(all.end(), words.begin(), words.end());
  return all;
}

std::size_t count_tokens(std::string_view text) {
  if (text.empty()) return 0;
  std::size_t total = !is_space(text[0]);
  // Blocks short enough for a sum in one byte, which the compiler makes vector code of.
  constexpr std::size_t kBlock = 240;
  for (std::size_t i = 1; i < text.size(); i += kBlock) {
    const char *before = text.data() + i - 1, *here = before + 1;
    const std::size_t n = std::min(kBlock, text.size() - i);
    unsigned char begins = 0;
    for (std::size_t k = 0; k < n; ++k)
      begins =
          static_cast<unsigned char>(begins + (int{is_space(before[k])} & int{!is_space(here[k])}));
    total += begins;
  }
  return total;
}

std::vector<std::size_t> cut_between_tokens(std::string_view text, std::size_t size) {
  return cut(text, size, is_space);
}

std::size_t line_of(std::string_view text, std::size_t offset) {
  return 1 + std::size_t(std::count(text.begin(), text.begin() + offset, '\n'));
}

std::string_view token_at(std::string_view text, std::size_t offset) {
  const std::string_view rest = text.substr(offset);
  return rest.substr(0, std::find_if(rest.begin(), rest.end(), is_space) - rest.begin());
}

std::string printable(std::string_view token) {
  std::string shown(token.substr(0, kPrintedToken));
  for (char& c : shown)
    if (c < ' ' || c > '~') c = '?';
  return token.size() > kPrintedToken ? shown + "..." : shown;
}

}  // namespace cavea
