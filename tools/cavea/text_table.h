#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace cavea::program {

/// 1234567 as 1,234,567.
std::string grouped(std::int64_t number);

/// A table in columns as wide as their widest cell; the first is set to the left, the others to the
/// right. Rows may differ in length.
class TextTable {
 public:
  void row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// The lines, each indented by two blanks and ended.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace cavea::program
