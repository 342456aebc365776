#include "cavea/io/medit_bytes.h"

#include "cavea/base/error.h"

namespace cavea::medit {
namespace {

constexpr std::size_t kRowsPerBlock = 16384;    // enough to outweigh starting a task
constexpr std::int64_t kOwnOrder = 1;           // the first number of a file of our byte order
constexpr std::int64_t kOtherOrder = 16777216;  // and of the other one: 1 with its bytes reversed

}  // namespace

MeditBytes::MeditBytes(std::span<const char> bytes, std::string name)
    : bytes_(bytes), name_(std::move(name)) {
  read_header();
  find_sections();
}

void MeditBytes::read_header() {
  std::size_t at = 0;
  const std::int64_t magic = take(at, sizeof(std::int32_t));
  if (magic != kOwnOrder && magic != kOtherOrder)
    fail(0, "not a binary Medit mesh: it does not begin with the number 1");
  swap_ = magic == kOtherOrder;
  version_ = std::int32_t(take(at, sizeof(std::int32_t)));
  if (version_ < kFirstVersion || version_ > kLastVersion)
    fail(sizeof(std::int32_t), fmt::format("version {}; only {} to {} can be read", version_,
                                           kFirstVersion, kLastVersion));
}

void MeditBytes::find_sections() {
  bool dimension = false;
  for (std::size_t next = 2 * sizeof(std::int32_t);;) {
    std::size_t at = next;
    if (at == bytes_.size())
      fail(at, fmt::format("the file is cut short: it ends without the keyword {}", kEndName));
    const auto code = std::int32_t(take(at, sizeof(std::int32_t)));
    if (code == kEndCode) break;
    const std::int64_t end = take(at, position_size());
    if (end < std::int64_t(at) || std::uint64_t(end) > bytes_.size())
      fail(next, fmt::format("keyword {}: the next one cannot be at byte {}, in a file of {}", code,
                             end, bytes_.size()));
    if (code == kDimensionCode) {
      if (dimension) fail(next, fmt::format("the keyword {} is given twice", kDimensionName));
      const std::int64_t value = take(at, sizeof(std::int32_t));
      if (value != kDimension)
        fail(next, fmt::format("{} is {}; only {} can be read", kDimensionName, value, kDimension));
      dimension = true;
    } else {
      sections_.push_back(take_section(code, next, at, std::size_t(end)));
    }
    next = std::size_t(end);
  }
  if (!dimension) fail_whole(fmt::format("the keyword {} is missing", kDimensionName));
}

Section MeditBytes::take_section(std::int32_t code, std::size_t at, std::size_t begin,
                                 std::size_t end) const {
  Section s;
  s.keyword = find_keyword(code);
  const std::string_view other = name_of_code(code);
  s.name = s.keyword       ? std::string(s.keyword->name)
           : other.empty() ? std::to_string(code)
                           : std::string(other);
  s.at = at;
  s.begin = begin;
  s.end = end;
  if (end - begin >= integer_size()) s.count = take(s.begin, integer_size());
  // A section that is skipped may be of a kind that has no count: then this number says nothing.
  if (!s.keyword && s.count > std::int64_t(end - begin)) s.count = -1;
  if (s.keyword && s.count < 0)
    fail(at, fmt::format("{} announces a negative count, or none: {}", s.name, s.count));
  return s;
}

std::int64_t MeditBytes::take(std::size_t& at, std::size_t size) const {
  if (size > bytes_.size() - at) fail(bytes_.size(), "the file is cut short: a number is due here");
  const char* p = bytes_.data() + at;
  at += size;
  if (size == sizeof(std::int64_t))
    return swap_ ? load<std::int64_t, true>(p) : load<std::int64_t, false>(p);
  return swap_ ? load<std::int32_t, true>(p) : load<std::int32_t, false>(p);
}

std::vector<Block> MeditBytes::blocks(const Section& s, RowLayout layout) const {
  const std::size_t row =
      std::size_t(layout.reals) * real_size() + std::size_t(layout.integers) * integer_size();
  const std::size_t room = s.end - s.begin;
  // By division: the product of a senseless count may overflow.
  if (room % row != 0 || room / row != std::size_t(s.count))
    fail(s.at, fmt::format("{} announces {} entities of {} bytes, but has {} bytes", s.name,
                           s.count, row, room));
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < std::size_t(s.count); i += kRowsPerBlock)
    blocks.push_back(
        {s.begin + i * row, s.end, i, std::min(std::size_t(s.count), i + kRowsPerBlock), 0});
  return blocks;
}

std::int64_t MeditBytes::take_small_integer(Section& s) const {
  if (s.end - s.begin < sizeof(std::int32_t))
    fail(s.begin, fmt::format("{}: a number is due here", s.name));
  return take(s.begin, sizeof(std::int32_t));
}

void MeditBytes::fail(std::size_t at, std::string_view what) const {
  throw InputError(fmt::format("{}: byte {}: {}", name_, at, what));
}

void MeditBytes::fail_whole(std::string_view what) const {
  throw InputError(fmt::format("{}: {}", name_, what));
}

}  // namespace cavea::medit
