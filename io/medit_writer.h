#pragma once
#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "cavea/base/parallel.h"
#include "cavea/io/medit.h"
#include "cavea/io/output_file.h"

// Writing of Medit files, ASCII and binary alike. An encoder turns numbers into text or bytes.
namespace cavea::medit {

using Buffer = fmt::memory_buffer;

inline void append(OutputFile& file, const Buffer& buffer) {
  file.append({buffer.data(), buffer.size()});
}

/// A row a line; doubles with the fewest digits that give the same double again.
class TextEncoder {
 public:
  explicit TextEncoder(Buffer& out) : out_(out) {}
  void real(double x) { fmt::format_to(fmt::appender(out_), FMT_COMPILE("{} "), x); }
  void integer(std::int32_t i) {
    const fmt::format_int digits(i);
    out_.append(digits.data(), digits.data() + digits.size());
    out_.push_back(' ');
  }
  void end_row() { out_[out_.size() - 1] = '\n'; }

 private:
  Buffer& out_;
};

/// Numbers in the byte order of this machine: a reader tells it from the file's first number.
class ByteEncoder {
 public:
  explicit ByteEncoder(Buffer& out) : out_(out) {}
  void real(double x) { put(&x, sizeof x); }
  void integer(std::int32_t i) { put(&i, sizeof i); }
  void end_row() {}
  static std::size_t row_size(RowLayout row) {
    return std::size_t(row.reals) * sizeof(double) +
           std::size_t(row.integers) * sizeof(std::int32_t);
  }

 private:
  // The buffer's append() is made for texts: for a number it takes five times as long.
  void put(const void* value, std::size_t size) {
    const std::size_t at = out_.size();
    out_.resize(at + size);
    std::memcpy(out_.data() + at, value, size);
  }
  Buffer& out_;
};

template <class Encoder>
void write_row(Encoder& out, double x) {
  out.real(x);
}
template <class Encoder>
void write_row(Encoder& out, const Vec3& p) {
  out.real(p.x);
  out.real(p.y);
  out.real(p.z);
}
template <class Encoder>
void write_row(Encoder& out, std::int32_t index) {
  out.integer(index + 1);
}
template <class Encoder, std::size_t N>
void write_row(Encoder& out, const std::array<std::int32_t, N>& indices) {
  for (const std::int32_t index : indices) out.integer(index + 1);
}

/// Writes rows [0, n): encode(buffer, begin, end) runs on blocks of them in parallel, and the file
/// gets them in order, while the next ones are encoded. Few enough blocks at a time that the
/// buffers stay small beside the mesh.
template <class Encode>
void write_blocks(OutputFile& file, std::size_t n, Encode&& encode) {
  constexpr std::size_t kRowsPerBlock = 8192;
  constexpr std::size_t kBlocksAtOnce = 32;
  const std::size_t blocks = (n + kRowsPerBlock - 1) / kRowsPerBlock;
  std::vector<Buffer> encoded, next;
  const auto encode_from = [&](std::size_t first) {
    next.resize(std::min(kBlocksAtOnce, blocks - std::min(blocks, first)));
    parallel_tasks(next.size(), [&](std::size_t k) {
      next[k].clear();
      const std::size_t begin = (first + k) * kRowsPerBlock;
      encode(next[k], begin, std::min(n, begin + kRowsPerBlock));
    });
  };
  encode_from(0);
  for (std::size_t first = kBlocksAtOnce; !next.empty(); first += kBlocksAtOnce) {
    encoded.swap(next);
    run_together(
        [&] {
          for (const Buffer& buffer : encoded) append(file, buffer);
        },
        [&] { encode_from(first); });
  }
}

/// Writes the rows of a section, without its header. `refs` is null where it has none; an empty
/// list stands for zeros.
template <class Encoder, class Rows, class Refs>
void write_rows(OutputFile& file, const Rows& rows, Refs refs) {
  write_blocks(file, rows.size(), [&](Buffer& buffer, std::size_t begin, std::size_t end) {
    Encoder out(buffer);
    for (std::size_t i = begin; i < end; ++i) {
      write_row(out, rows[i]);
      if constexpr (!std::is_null_pointer_v<Refs>) out.integer(refs->empty() ? 0 : (*refs)[i]);
      out.end_row();
    }
  });
}

/// Calls f(keyword, rows, refs) for each section that is to be written: the ones that are not
/// empty.
template <class F>
void for_each_written(const MeshData& data, F&& f) {
  for (const Keyword& keyword : keywords())
    visit_section(keyword.id, data, [&](const auto& rows, auto refs) {
      if (!rows.empty()) f(keyword, rows, refs);
    });
}

}  // namespace cavea::medit
