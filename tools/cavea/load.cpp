#include "load.h"

#include <cstdio>

#include "cavea/base/error.h"
#include "cavea/io/formats.h"

namespace cavea::program {
namespace {

std::vector<std::int32_t> find_unused(const MeshData& data) {
  std::vector<char> used(data.vertices.size(), 0);
  for (const auto& tet : data.tets)
    for (const std::int32_t v : tet) used[v] = 1;
  std::vector<std::int32_t> unused;
  for (std::size_t v = 0; v < used.size(); ++v)
    if (!used[v]) unused.push_back(std::int32_t(v));
  return unused;
}

}  // namespace

LoadedMesh build_loaded(const MeshData& data, std::vector<std::string> warnings,
                        const BuildOptions& options) {
  BuildResult built = build(data, options);
  for (std::string& text : built.summary.warnings()) warnings.push_back(std::move(text));
  std::vector<std::int32_t> unused;
  if (built.summary.unused_vertices != 0) unused = find_unused(data);
  return {std::move(built.mesh), built.summary, std::move(unused), std::move(warnings)};
}

LoadedMesh load_mesh(const std::filesystem::path& file, const std::filesystem::path& sizes,
                     const BuildOptions& options) {
  std::vector<std::string> warnings;
  MeshData data = read_mesh(file, &warnings);
  if (!sizes.empty()) data.sizes = read_sizes(sizes, data.vertices.size());
  try {
    return build_loaded(data, std::move(warnings), options);
  } catch (const InputError& e) {
    throw InputError(file.string() + ": " + e.what());  // lists do not know where they came from
  }
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& text : warnings)
    std::fputs(("cavea: warning: " + text + "\n").c_str(), stderr);
}

}  // namespace cavea::program
