#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cavea/mesh/mesh_data.h"

namespace cavea {

/// How write_mesh() writes.
struct WriteOptions {
  /// Write data.sizes, when there are any, into the .sol or .solb beside a Medit mesh.
  bool sizes = true;
  /// Lowest version of a Medit file, 2 or 3. A binary file of 2 GiB or more is of version 3 anyway:
  /// version 2 has no room for its byte positions.
  int medit_version = 2;
};

/// One format of meshes that this build knows, by its extension.
struct FormatInfo {
  std::string_view extension;  ///< with the dot
  std::string_view name;
  bool readable = false, writable = false;
  std::string_view sizes_extension;  ///< of the file of sizes beside it; empty if there is none
};

std::vector<FormatInfo> formats();
bool is_writable_format(const std::filesystem::path& path);

/// Reads a mesh; the extension says the format (docs/formats.md). Indices come out zero-based and
/// in range, coordinates finite; whether it is a mesh is for build() to judge. The file must not be
/// cut short by others meanwhile: it is read through a memory map. \param warnings what was skipped
/// is added to it; may be null. \throw InputError naming the file, the line or byte offset and the
/// entity.
MeshData read_mesh(const std::filesystem::path& path, std::vector<std::string>* warnings);

/// Writes a mesh; the extension says the format. The file appears whole, under its name, or not at
/// all; an older file of that name stays until then. Empty reference lists stand for zeros.
/// \throw OutputError if it cannot be written or no format is known by that extension; InputError
/// if the lists of `data` do not fit together; OptionError for an unknown Medit version.
void write_mesh(const std::filesystem::path& path, const MeshData& data,
                const WriteOptions& options = {});

/// Reads one positive size a vertex, in the mesh's unit, from a .sol or .solb.
/// \throw InputError as read_mesh(); also if the file holds a vector or tensor, several fields, a
/// size that is not positive, or another number of sizes than `expected_count`.
std::vector<double> read_sizes(const std::filesystem::path& path, std::size_t expected_count);

/// Reads one number a vertex, of either sign, from the same files: the values of a level set.
/// \throw InputError as read_sizes(), but for the sign.
std::vector<double> read_values(const std::filesystem::path& path, std::size_t expected_count);

/// Writes one size a vertex into a .sol or .solb, whole or not at all.
/// \throw OutputError as write_mesh().
void write_sizes(const std::filesystem::path& path, std::span<const double> sizes);

}  // namespace cavea
