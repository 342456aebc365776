#pragma once
#include "cavea/io/formats.h"
#include "cavea/io/output_file.h"

namespace cavea {

/// What a format is made of: one file format_x.cpp makes one, one row in formats.cpp registers it.
/// What the scalars of a solution file are.
enum class SolutionKind { kSizes, kValues };

/// A null function says that the format cannot do that.
struct Format {
  std::string_view extension;
  std::string_view name;
  MeshData (*read)(const std::filesystem::path&, std::vector<std::string>* warnings) = nullptr;
  void (*write)(OutputFile&, const MeshData&, const WriteOptions&) = nullptr;

  std::string_view sizes_extension;
  /// Checks that the values are positive where `kind` is kSizes.
  std::vector<double> (*read_solution)(const std::filesystem::path&, std::size_t expected_count,
                                       SolutionKind kind) = nullptr;
  void (*write_sizes)(OutputFile&, std::span<const double>) = nullptr;
};

Format medit_ascii_format();
Format medit_binary_format();
Format vtu_format();  ///< only where the build has VTK

}  // namespace cavea
