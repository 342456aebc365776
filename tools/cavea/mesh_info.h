#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cavea/mesh/mesh_data.h"
#include "cavea/remesh/report.h"

namespace cavea::program {

/// What `cavea info` finds out.
struct Info {
  MeshSummary summary;
  bool sizes_known = false;
  /// Edge lengths in the mesh's unit, and their histogram relative to the mean.
  LengthStatistics euclidean, relative;
  std::vector<std::string> violations;
  std::vector<std::string> warnings;
};

/// Measures lists that were read from `file`, with the sizes beside it if there are any.
/// \throw InputError if they are no mesh
Info measure(const std::filesystem::path& file, MeshData data, std::vector<std::string> warnings);

}  // namespace cavea::program
