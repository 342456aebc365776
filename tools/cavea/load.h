#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cavea/mesh/build.h"

namespace cavea::program {

/// A mesh out of a file, and what was odd about it.
struct LoadedMesh {
  TetMesh mesh;
  BuildSummary repairs;
  std::vector<std::int32_t> unused_vertices;  ///< those of the file that were dropped, rising
  std::vector<std::string> warnings;          ///< of the reader, then of build()
};

/// Builds the mesh and adds what build() put right to the warnings. \throw InputError
LoadedMesh build_loaded(MeshData data, std::vector<std::string> warnings,
                        const BuildOptions& options = {});

/// Reads and builds; with the sizes at the vertices in the file `sizes`, unless its name is empty.
/// \throw InputError
LoadedMesh load_mesh(const std::filesystem::path& file, const std::filesystem::path& sizes,
                     const BuildOptions& options);

/// A line on standard error for each.
void print_warnings(const std::vector<std::string>& warnings);

}  // namespace cavea::program
