#include "mesh_info.h"

#include <fmt/format.h>

#include <algorithm>

#include "cavea/base/error.h"
#include "cavea/io/formats.h"
#include "cavea/mesh/check.h"
#include "load.h"
#include "output_names.h"
#include "text_table.h"

namespace cavea::program {
namespace {

namespace fs = std::filesystem;

LengthStatistics lengths_in_size(TetMesh& mesh, float size) {
  std::fill(mesh.sizes.begin(), mesh.sizes.end(), size);
  return length_statistics(mesh);
}

/// Why the file as it stands is not sound: what build() had to put right in its tets, and what
/// check() finds in the mesh that came out of it.
std::vector<std::string> find_violations(const LoadedMesh& loaded) {
  std::vector<std::string> found;
  const auto add = [&found](std::int64_t count, const char* what) {
    if (count) found.push_back(fmt::format("{} {}", grouped(count), what));
  };
  add(loaded.repairs.turned_tets, "tets of negative volume (measured turned over)");
  add(loaded.repairs.flat_tets, "tets of zero volume");
  const CheckResult result = check(loaded.mesh, {.allow_flat_tets = true});
  if (!result.sound()) found.push_back(result.message());
  return found;
}

/// The sizes beside the file, if there are any and they can be used.
void take_sizes(const fs::path& mesh_file, MeshData& data, std::vector<std::string>& warnings) {
  const fs::path file = sizes_beside(mesh_file);
  if (file.empty() || !fs::exists(file)) return;
  try {
    data.sizes = read_sizes(file, data.vertices.size());
  } catch (const InputError& e) {
    warnings.push_back(fmt::format("the sizes are not used: {}", e.what()));
  }
}

}  // namespace

Info measure(const fs::path& file, MeshData data, std::vector<std::string> warnings) {
  take_sizes(file, data, warnings);
  LoadedMesh loaded = build_loaded(std::move(data), std::move(warnings));
  TetMesh& mesh = loaded.mesh;
  Info info;
  info.warnings = loaded.warnings;
  info.violations = find_violations(loaded);
  info.summary.counts = count(mesh);
  info.summary.quality = quality_statistics(mesh);
  info.sizes_known =
      !mesh.sizes.empty() && *std::min_element(mesh.sizes.begin(), mesh.sizes.end()) > 0;
  if (info.sizes_known) info.summary.lengths = length_statistics(mesh);
  info.euclidean = lengths_in_size(mesh, 1);
  info.relative = lengths_in_size(mesh, static_cast<float>(info.euclidean.mean));
  return info;
}

}  // namespace cavea::program
