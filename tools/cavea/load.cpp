#include "load.h"

#include <cstdio>

#include "cavea/base/error.h"
#include "cavea/io/formats.h"

namespace cavea::program {

LoadedMesh build_loaded(MeshData data, std::vector<std::string> warnings,
                        const BuildOptions& options) {
  BuildResult built = build(std::move(data), options);
  for (std::string& text : built.summary.warnings()) warnings.push_back(std::move(text));
  return {std::move(built.mesh), built.summary, std::move(built.unused_vertices),
          std::move(warnings)};
}

LoadedMesh load_mesh(const std::filesystem::path& file, const std::filesystem::path& sizes,
                     const BuildOptions& options) {
  std::vector<std::string> warnings;
  MeshData data = read_mesh(file, &warnings);
  if (!sizes.empty()) data.sizes = read_sizes(sizes, data.vertices.size());
  try {
    return build_loaded(std::move(data), std::move(warnings), options);
  } catch (const InputError& e) {
    throw InputError(file.string() + ": " + e.what());  // lists do not know where they came from
  }
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings)
    std::fputs(("cavea: warning: " + text + "\n").c_str(), stderr);
}

}  // namespace cavea::program
