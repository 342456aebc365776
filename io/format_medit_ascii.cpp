#include "cavea/io/format.h"
#include "cavea/io/mapped_file.h"
#include "cavea/io/medit_text.h"
#include "cavea/io/medit_writer.h"

namespace cavea {
namespace {

namespace fs = std::filesystem;
using medit::Buffer;

template <class... Values>
void append_text(OutputFile& file, fmt::format_string<Values...> format, Values&&... values) {
  Buffer buffer;
  fmt::format_to(fmt::appender(buffer), format, std::forward<Values>(values)...);
  medit::append(file, buffer);
}

void append_header(OutputFile& file, int version) {
  append_text(file, "{} {}\n{} {}\n", medit::kVersionName, version, medit::kDimensionName,
              medit::kDimension);
}

MeshData read(const fs::path& path, std::vector<std::string>* warnings) {
  const MappedFile map(path);
  return medit::read_medit(medit::MeditText(map.bytes(), path.string()), warnings);
}

void write(OutputFile& file, const MeshData& data, const WriteOptions& options) {
  medit::check_written_version(options.medit_version);
  append_header(file, options.medit_version);
  medit::for_each_written(data, [&](const medit::Keyword& keyword, const auto& rows, auto refs) {
    append_text(file, "\n{}\n{}\n", keyword.name, rows.size());
    medit::write_rows<medit::TextEncoder>(file, rows, refs);
  });
  append_text(file, "\n{}\n", medit::kEndName);
}

std::vector<double> read_solution(const fs::path& path, std::size_t expected_count,
                                  SolutionKind kind) {
  const MappedFile map(path);
  return medit::read_solution(medit::MeditText(map.bytes(), path.string()), expected_count, kind);
}

void write_solution(OutputFile& file, std::span<const double> sizes) {
  append_header(file, WriteOptions{}.medit_version);
  append_text(file, "\n{}\n{}\n1 {}\n", medit::kSolutionName, sizes.size(), medit::kScalar);
  medit::write_rows<medit::TextEncoder>(file, sizes, nullptr);
  append_text(file, "\n{}\n", medit::kEndName);
}

}  // namespace

Format medit_ascii_format() {
  return {".mesh", "Medit ASCII", read, write, ".sol", read_solution, write_solution};
}

}  // namespace cavea
