#pragma once
// The Medit readers on bytes in memory instead of a file. A vector's end is guarded by the address
// sanitizer, a memory map's is not.
#include <string_view>
#include <vector>

#include "cavea/io/medit_bytes.h"
#include "cavea/io/medit_text.h"

namespace cavea::test {

enum class Encoding { text, bytes };

/// Throws InputError, as read_mesh() does, with "memory" as the file's name.
inline MeshData parse(std::string_view input, Encoding encoding,
                      std::vector<std::string>* warnings = nullptr) {
  std::vector<char> copy(input.begin(), input.end());
  if (encoding == Encoding::text)
    return medit::read_medit(medit::MeditText(copy, "memory"), warnings);
  return medit::read_medit(medit::MeditBytes(copy, "memory"), warnings);
}

inline std::vector<double> parse_sizes(std::string_view input, Encoding encoding,
                                       std::size_t expected) {
  std::vector<char> copy(input.begin(), input.end());
  if (encoding == Encoding::text)
    return medit::read_solution(medit::MeditText(copy, "memory"), expected, SolutionKind::kSizes);
  return medit::read_solution(medit::MeditBytes(copy, "memory"), expected, SolutionKind::kSizes);
}

}  // namespace cavea::test
