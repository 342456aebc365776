#include "prepare.h"

#include <fmt/format.h>

#include <memory>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/field/mesh_size_field.h"
#include "cavea/io/formats.h"
#include "grid_domain.h"

namespace cavea::program {
namespace {

/// The sizes that were read with the mesh, as the field that the library asks.
SizeField field_of(const RemeshArguments& arguments, const TetMesh& mesh) {
  if (arguments.sizes.empty()) return {};
  return [map = std::make_shared<MeshSizeField>(mesh)](const Vec3& p) { return (*map)(p); };
}

/// The level set's values at the vertices of the mesh. \throw InputError
std::vector<double> values_at(const LoadedMesh& loaded, const std::string& file) {
  const std::vector<std::int32_t>& unused = loaded.unused_vertices;
  const std::vector<double> all = read_values(file, loaded.mesh.points.size() + unused.size());
  std::vector<double> values;
  for (std::size_t v = 0, k = 0; v < all.size(); ++v)
    if (k < unused.size() && std::size_t(unused[k]) == v)
      ++k;
    else
      values.push_back(all[v]);
  return values;
}

CutLevelSet cut_by_values(const ImplicitArguments& implicit, LoadedMesh& loaded) {
  const std::vector<double> values = values_at(loaded, implicit.values);
  try {
    CutResult cut = cut_along(loaded.mesh, values, to_cut_options(implicit));
    loaded.mesh = std::move(cut.mesh);
    if (cut.report.interface_triangles == 0)
      loaded.warnings.push_back(implicit.values +
                                ": there is no interface: one side is empty, as it is smaller than "
                                "what a cut makes, outside the mesh, or removed");
    return {implicit.values, cut.report, {}};
  } catch (const InputError& e) {
    throw InputError(implicit.values + ": " + e.what());  // values do not know where they came from
  }
}

}  // namespace

Prepared prepare(const RemeshArguments& arguments, Options& options) {
  Prepared out;
  const bool has_grid = arguments.implicit && is_grid(arguments.input);
  if (!has_grid) out.loaded = load_mesh(arguments.input, arguments.sizes, arguments.build);
  out.field = field_of(arguments, out.loaded.mesh);
  if (!arguments.implicit) return out;
  run_in_arena(options.threads > 0 ? options.threads : default_threads(), [&] {
    if (has_grid) {
      GridCut cut = cut_by_grids(arguments, options);
      out.loaded.mesh = std::move(cut.mesh);
      out.level_sets = std::move(cut.level_sets);
    } else {
      out.level_sets.push_back(cut_by_values(*arguments.implicit, out.loaded));
    }
  });
  return out;
}

}  // namespace cavea::program
