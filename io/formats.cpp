#include "cavea/io/formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/io/format.h"

namespace cavea {
namespace {

namespace fs = std::filesystem;

/// The formats, one row each.
std::vector<Format> table() {
  return {
      medit_ascii_format(),
      medit_binary_format(),
#ifdef CAVEA_HAVE_VTK
      vtu_format(),
#endif
  };
}

/// The format whose `member` (its extension or that of its sizes) is the extension of the path.
std::optional<Format> find_format(const fs::path& path, std::string_view Format::*member) {
  const std::string extension = path.extension().string();
  for (const Format& format : table())
    if (!extension.empty() && format.*member == extension) return format;
  return std::nullopt;
}

/// The extensions of the formats that have the function `able`, for messages.
template <class Function>
std::string extensions(std::string_view Format::*member, Function Format::*able) {
  std::string text;
  for (const Format& format : table())
    if (format.*able) text += fmt::format("{}{}", text.empty() ? "" : ", ", format.*member);
  return text;
}

/// The format of the path, which has the function `able`; else an error of type E.
template <class E, class Function>
Format require_format(const fs::path& path, std::string_view Format::*member,
                      Function Format::*able) {
  const std::optional<Format> format = find_format(path, member);
  if (format && (*format).*able) return *format;
  throw E(fmt::format("{}: no format is known by the extension '{}' (known: {})", path.string(),
                      path.extension().string(), extensions(member, able)));
}

void check_length(std::string_view list, std::size_t length, std::size_t wanted) {
  if (length != 0 && length != wanted)
    throw InputError(
        fmt::format("the list {} holds {} entries where {} are due", list, length, wanted));
}

/// Whether all indices of the rows (numbers, or arrays of them) are in [0, limit).
template <class Rows>
bool in_range(const Rows& rows, std::size_t limit) {
  const auto fits = [&](std::int32_t i) { return i >= 0 && std::size_t(i) < limit; };
  return parallel_reduce(
      rows.size(), true,
      [&](std::size_t begin, std::size_t end) {
        return std::all_of(rows.begin() + begin, rows.begin() + end, [&](const auto& row) {
          if constexpr (std::is_integral_v<std::remove_cvref_t<decltype(row)>>)
            return fits(row);
          else
            return std::all_of(row.begin(), row.end(), fits);
        });
      },
      [](bool a, bool b) { return a && b; });
}

template <class Rows>
void check_indices(std::string_view list, const Rows& rows, std::size_t limit) {
  if (!in_range(rows, limit))
    throw InputError(fmt::format("the list {} has an index outside of [0, {})", list, limit));
}

/// Pairs of an index below `first` and one below `second`.
void check_pairs(std::string_view list, const std::vector<std::array<std::int32_t, 2>>& pairs,
                 std::size_t first, std::size_t second) {
  const auto fits = [](std::int32_t i, std::size_t limit) {
    return i >= 0 && std::size_t(i) < limit;
  };
  for (const auto& [a, b] : pairs)
    if (!fits(a, first) || !fits(b, second))
      throw InputError(fmt::format("the list {} has an index outside of [0, {}) or [0, {})", list,
                                   first, second));
}

/// Writers rely on these; a file that breaks them could not be read again.
void check_lists(const MeshData& d) {
  check_length("vertex_refs", d.vertex_refs.size(), d.vertices.size());
  check_length("tet_refs", d.tet_refs.size(), d.tets.size());
  check_length("triangle_refs", d.triangle_refs.size(), d.triangles.size());
  check_length("edge_refs", d.edge_refs.size(), d.edges.size());
  check_length("sizes", d.sizes.size(), d.vertices.size());
  check_length("parts", d.parts.size(), d.tets.size());
  check_indices("tets", d.tets, d.vertices.size());
  check_indices("triangles", d.triangles, d.vertices.size());
  check_indices("edges", d.edges, d.vertices.size());
  check_indices("corners", d.corners, d.vertices.size());
  check_indices("ridges", d.ridges, d.edges.size());
  check_indices("required_vertices", d.required_vertices, d.vertices.size());
  check_indices("required_edges", d.required_edges, d.edges.size());
  check_indices("required_triangles", d.required_triangles, d.triangles.size());
  check_indices("required_tets", d.required_tets, d.tets.size());
  check_pairs("normal_at_vertices", d.normal_at_vertices, d.vertices.size(), d.normals.size());
  check_pairs("tangent_at_vertices", d.tangent_at_vertices, d.vertices.size(), d.tangents.size());
}

std::vector<double> read_solution(const fs::path& path, std::size_t expected_count,
                                  SolutionKind kind) {
  return require_format<InputError>(path, &Format::sizes_extension, &Format::read_solution)
      .read_solution(path, expected_count, kind);
}

}  // namespace

std::vector<FormatInfo> formats() {
  std::vector<FormatInfo> infos;
  for (const Format& f : table())
    infos.push_back(
        {f.extension, f.name, f.read != nullptr, f.write != nullptr, f.sizes_extension});
  return infos;
}

bool is_writable_format(const fs::path& path) {
  const std::optional<Format> format = find_format(path, &Format::extension);
  return format && format->write;
}

MeshData read_mesh(const fs::path& path, std::vector<std::string>* warnings) {
  return require_format<InputError>(path, &Format::extension, &Format::read).read(path, warnings);
}

void write_mesh(const fs::path& path, const MeshData& data, const WriteOptions& options) {
  const Format format = require_format<OutputError>(path, &Format::extension, &Format::write);
  check_lists(data);
  std::optional<OutputFile> sizes;
  if (options.sizes && format.write_sizes && !data.sizes.empty()) {
    sizes.emplace(fs::path(path).replace_extension(format.sizes_extension));
    format.write_sizes(*sizes, data.sizes);
  }
  OutputFile mesh(path);
  format.write(mesh, data, options);
  // Both are complete on disk before either gets its name.
  if (sizes) sizes->publish();
  mesh.publish();
}

std::vector<double> read_sizes(const fs::path& path, std::size_t expected_count) {
  return read_solution(path, expected_count, SolutionKind::kSizes);
}

std::vector<double> read_values(const fs::path& path, std::size_t expected_count) {
  return read_solution(path, expected_count, SolutionKind::kValues);
}

void write_sizes(const fs::path& path, std::span<const double> sizes) {
  const Format format =
      require_format<OutputError>(path, &Format::sizes_extension, &Format::write_sizes);
  OutputFile file(path);
  format.write_sizes(file, sizes);
  file.publish();
}

}  // namespace cavea
