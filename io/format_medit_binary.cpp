#include <limits>

#include "cavea/io/format.h"
#include "cavea/io/mapped_file.h"
#include "cavea/io/medit_bytes.h"
#include "cavea/io/medit_writer.h"

namespace cavea {
namespace {

namespace fs = std::filesystem;
using medit::Buffer;
using medit::ByteEncoder;
using medit::RowLayout;

/// Writes keywords, each with the byte position of the next one.
class KeywordWriter {
 public:
  KeywordWriter(OutputFile& file, int version) : file_(file), version_(version) {
    put(std::int32_t{1});  // tells the byte order
    put(std::int32_t{version});
    flush();
    open(medit::kDimensionCode, sizeof(std::int32_t));
    put(std::int32_t{medit::kDimension});
    flush();
  }

  /// Bytes of a header of version 3, the longest: keyword, position of the next one, count.
  static constexpr std::size_t kLongestHeader = 16;

  template <class Rows, class Refs>
  void section(std::int32_t code, const Rows& rows, Refs refs) {
    const RowLayout row = medit::layout_of(rows.data(), !std::is_null_pointer_v<Refs>);
    open(code, sizeof(std::int32_t) + rows.size() * ByteEncoder::row_size(row));
    put(static_cast<std::int32_t>(rows.size()));
    flush();
    medit::write_rows<ByteEncoder>(file_, rows, refs);
  }
  void field(std::span<const double> values) {
    open(medit::kSolutionCode, 3 * sizeof(std::int32_t) + values.size() * sizeof(double));
    put(static_cast<std::int32_t>(values.size()));
    put(std::int32_t{1});  // one field
    put(std::int32_t{medit::kScalar});
    flush();
    medit::write_rows<ByteEncoder>(file_, values, nullptr);
  }
  void end() {
    put(medit::kEndCode);
    position(0);  // none follows
    flush();
  }

 private:
  void open(std::int32_t code, std::size_t size) {
    next_ += sizeof code + position_size() + size;
    put(code);
    position(next_);
  }
  std::size_t position_size() const {
    return version_ >= 3 ? sizeof(std::int64_t) : sizeof(std::int32_t);
  }
  void position(std::size_t at) {
    if (version_ >= 3)
      put(static_cast<std::int64_t>(at));
    else
      put(static_cast<std::int32_t>(at));
  }
  template <class T>
  void put(T value) {
    const char* bytes = reinterpret_cast<const char*>(&value);
    buffer_.append(bytes, bytes + sizeof value);
  }
  void flush() {
    medit::append(file_, buffer_);
    buffer_.clear();
  }

  OutputFile& file_;
  int version_;
  std::size_t next_ = 2 * sizeof(std::int32_t);  ///< where the next keyword will be
  Buffer buffer_;
};

/// Bytes of the file, if anything a little too many.
std::size_t size_of(const MeshData& data) {
  std::size_t size = 4 * KeywordWriter::kLongestHeader;  // magic, version, Dimension, End
  medit::for_each_written(data, [&](const medit::Keyword&, const auto& rows, auto refs) {
    const RowLayout row = medit::layout_of(rows.data(), !std::is_null_pointer_v<decltype(refs)>);
    size += KeywordWriter::kLongestHeader + rows.size() * ByteEncoder::row_size(row);
  });
  return size;
}

/// The version that is asked for, or 3 where byte positions need 64 bits.
int version_for(std::size_t size, int asked) {
  return size > std::size_t(std::numeric_limits<std::int32_t>::max()) ? 3 : asked;
}

MeshData read(const fs::path& path, std::vector<std::string>* warnings) {
  const MappedFile map(path);
  return medit::read_medit(medit::MeditBytes(map.bytes(), path.string()), warnings);
}

void write(OutputFile& file, const MeshData& data, const WriteOptions& options) {
  medit::check_written_version(options.medit_version);
  KeywordWriter out(file, version_for(size_of(data), options.medit_version));
  medit::for_each_written(data, [&](const medit::Keyword& keyword, const auto& rows, auto refs) {
    out.section(keyword.code, rows, refs);
  });
  out.end();
}

std::vector<double> read_solution(const fs::path& path, std::size_t expected_count,
                                  SolutionKind kind) {
  const MappedFile map(path);
  return medit::read_solution(medit::MeditBytes(map.bytes(), path.string()), expected_count, kind);
}

void write_solution(OutputFile& file, std::span<const double> sizes) {
  const std::size_t size = 5 * KeywordWriter::kLongestHeader + sizes.size_bytes();
  KeywordWriter out(file, version_for(size, WriteOptions{}.medit_version));
  out.field(sizes);
  out.end();
}

}  // namespace

Format medit_binary_format() {
  return {".meshb", "Medit binary", read, write, ".solb", read_solution, write_solution};
}

}  // namespace cavea
