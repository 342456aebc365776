#include "cavea/io/medit_text.h"

#include <algorithm>

#include "cavea/base/error.h"

namespace cavea::medit {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 18;  // enough to outweigh starting a task

}  // namespace

double TokenCursor::unusual_real() {
  const char* stop = std::find_if(token_, end_, is_space);
  std::string spelled(token_, stop);
  if (spelled.size() > 1 && spelled[0] == '+' && spelled[1] != '-') spelled.erase(0, 1);
  for (char& c : spelled)
    if (c == 'D' || c == 'd') c = 'e';
  double value = 0;
  const char* last = spelled.data() + spelled.size();
  const auto [parsed, error] = std::from_chars(spelled.data(), last, value);
  if (parsed != last || error == std::errc::invalid_argument) refuse("a number");
  if (error == std::errc::result_out_of_range) {
    // Too small rounds to zero; too large has no double.
    if (spelled.find("e-") == std::string::npos && spelled.find("E-") == std::string::npos)
      fail(fmt::format("'{}' is too large for a double", printable({token_, stop})));
    value = spelled[0] == '-' ? -0.0 : 0.0;
  }
  p_ = stop;
  return value;
}

void TokenCursor::refuse(std::string_view due) const {
  const std::string_view token(token_, std::find_if(token_, end_, is_space));
  fail(fmt::format("{} is due, not '{}'", due, printable(token)));
}

MeditText::MeditText(std::span<char> text, std::string name)
    : text_(text.data(), text.size()), name_(std::move(name)) {
  const std::vector<std::string_view> words = scan_words(text);
  if (words.empty() || words.front() != kVersionName ||
      count_tokens({text_.data(), words.front().data()}) != 0)
    fail(0, fmt::format("not a Medit mesh: it does not begin with {}", kVersionName));
  find_sections(words);
}

void MeditText::find_sections(const std::vector<std::string_view>& words) {
  bool ended = false, dimension = false;
  for (std::size_t k = 0; k < words.size() && !ended; ++k) {
    const std::size_t end =
        k + 1 < words.size() ? std::size_t(words[k + 1].data() - text_.data()) : text_.size();
    ended = words[k] == kEndName;
    if (ended) continue;
    Section s = make_section(words[k], end);
    if (s.name == kVersionName) {
      if (k > 0) fail(s.at, fmt::format("the keyword {} is given twice", s.name));
      check_header(s, kFirstVersion, kLastVersion);
    } else if (s.name == kDimensionName) {
      if (dimension) fail(s.at, fmt::format("the keyword {} is given twice", s.name));
      check_header(s, kDimension, kDimension);
      dimension = true;
    } else {
      sections_.push_back(std::move(s));
    }
  }
  if (!dimension) fail_whole(fmt::format("the keyword {} is missing", kDimensionName));
  if (!ended)
    fail(text_.size(),
         fmt::format("the file is cut short: it ends without the keyword {}", kEndName));
}

Section MeditText::make_section(std::string_view word, std::size_t end) const {
  Section s;
  s.keyword = find_keyword(word);
  s.name = s.keyword ? std::string(word) : printable(word);
  s.at = std::size_t(word.data() - text_.data());
  s.begin = s.at + word.size();
  s.end = end;
  TokenCursor in(text_, s.begin, s.end);
  try {
    s.count = in.integer();
    s.begin = in.offset();
  } catch (const Fault& fault) {
    if (s.keyword || s.name == kSolutionName)
      fail(fault.at, fmt::format("count of {}: {}", s.name, fault.text));
  }
  if (s.count < 0 && s.keyword)
    fail(s.at, fmt::format("{} announces a negative count: {}", s.name, s.count));
  return s;
}

/// The count of the two header keywords is their value.
void MeditText::check_header(Section s, int smallest, int largest) const {
  if (s.count < smallest || s.count > largest)
    fail(s.at, fmt::format("{} is {}; only {} can be read", s.name,
                           s.count < 0 ? "not given" : std::to_string(s.count),
                           smallest == largest ? std::to_string(smallest)
                                               : fmt::format("{} to {}", smallest, largest)));
  if (count_tokens(text_.substr(s.begin, s.end - s.begin)) != 0)
    fail(s.at, fmt::format("{} is followed by more than one number", s.name));
}

std::vector<Block> MeditText::blocks(const Section& s, RowLayout layout) const {
  const std::size_t width = std::size_t(layout.reals + layout.integers);
  const std::string_view body = text_.substr(s.begin, s.end - s.begin);
  const std::vector<std::size_t> cuts = cut_between_tokens(body, kBlockBytes);
  std::vector<std::size_t> tokens(cuts.size() - 1);
  parallel_tasks(tokens.size(), [&](std::size_t k) {
    tokens[k] = count_tokens(body.substr(cuts[k], cuts[k + 1] - cuts[k]));
  });
  const std::size_t found = exclusive_scan(tokens);
  // By division: the product of a senseless count may overflow.
  if (found % width != 0 || found / width != std::size_t(s.count)) fail_count(s, width, found);
  const auto first_row_from = [&](std::size_t token) { return (token + width - 1) / width; };
  std::vector<Block> blocks(tokens.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    const std::size_t next = k + 1 < tokens.size() ? tokens[k + 1] : found;
    const std::size_t row = first_row_from(tokens[k]);
    blocks[k] = {s.begin + cuts[k], s.end, row, first_row_from(next), row * width - tokens[k]};
    // A row longer than the block: the block before reads it all.
    if (blocks[k].first_row >= blocks[k].last_row) blocks[k].skip = 0;
  }
  return blocks;
}

std::int64_t MeditText::take_small_integer(Section& s) const {
  TokenCursor in(text_, s.begin, s.end);
  try {
    const std::int64_t value = in.integer();
    s.begin = in.offset();
    return value;
  } catch (const Fault& fault) {
    fail(fault.at, fmt::format("{}: {}", s.name, fault.text));
  }
}

void MeditText::fail(std::size_t at, std::string_view what) const {
  throw InputError(fmt::format("{}: line {}: {}", name_, line_of(text_, at), what));
}

void MeditText::fail_whole(std::string_view what) const {
  throw InputError(fmt::format("{}: {}", name_, what));
}

void MeditText::fail_count(const Section& s, std::size_t width, std::size_t found) const {
  const std::string next =
      s.end < text_.size() ? fmt::format("the word '{}' in line {}",
                                         printable(token_at(text_, s.end)), line_of(text_, s.end))
                           : "the end of the file";
  fail(s.at, fmt::format("{} announces {} entities of {} numbers, but {} numbers stand before {}{}",
                         s.name, s.count, width, found, next, describe_odd_line(s, width)));
}

/// Most files have a line an entity: then the first line of another length is where to look.
std::string MeditText::describe_odd_line(const Section& s, std::size_t width) const {
  for (std::size_t begin = s.begin; begin < s.end;) {
    const std::size_t end = std::min(text_.find('\n', begin), s.end);
    const std::size_t tokens = count_tokens(text_.substr(begin, end - begin));
    if (tokens != 0 && tokens != width)
      return fmt::format("; the first line that does not hold {} is line {}", width,
                         line_of(text_, begin));
    begin = end + 1;
  }
  return "";
}

}  // namespace cavea::medit
