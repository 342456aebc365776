#include "grid_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cavea/base/error.h"
#include "cavea/implicit/mesh_level_set.h"
#include "cavea/vdb/grid.h"

namespace cavea::program {
namespace {

/// The share of the longest side of the active voxels' box that is added on each side, so that
/// tets outside have room.
constexpr double kMargin = 0.1;

std::string text(const Box& box) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", box.low.x, box.low.y,
                     box.low.z, box.high.x, box.high.y, box.high.z);
}

/// The box of --box. \throw OptionError if it is none, or does not meet the grid's
Box given_box(const std::vector<double>& v, const Box& of_grid) {
  const Box box{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  if (!(is_finite(box.low) && is_finite(box.high) && v[0] < v[3] && v[1] < v[4] && v[2] < v[5]))
    throw OptionError("--box must have its low corner below its high one along each axis");
  if (!box.overlaps(of_grid))
    throw OptionError(
        fmt::format("--box {} is outside of the grid, which is from {}", text(box), text(of_grid)));
  return box;
}

/// An open level set ends with the grid; around a closed one there is room.
Box domain(const ImplicitArguments& implicit, const Grid& grid) {
  Box box = grid.bounds();
  if (!implicit.box.empty()) return given_box(implicit.box, box);
  if (grid.is_open()) return box;
  const Vec3 side = box.high - box.low;
  const double margin = kMargin * std::max({side.x, side.y, side.z});
  box.low -= Vec3{margin, margin, margin};
  box.high += Vec3{margin, margin, margin};
  return box;
}

/// Chords of half the tolerance are about as long as remesh() wants its edges.
constexpr double kChordShare = 0.5;

/// What remesh() would set, but for the whole box, whatever is kept of it.
void set_hausd(const Box& box, Options& options) {
  constexpr double kHausd = 0.001;
  if (!options.hausd) options.hausd = kHausd * distance(box.low, box.high);
}

/// What remesh() would set, but more where voxels do not allow chords as short as that: the smooth
/// surface is to reach from the cut's triangles to the level set.
void set_bulge(const CutReport& cut, Options& options) {
  constexpr double kBulges = 3;
  if (!options.max_bulge && !options.faceted)
    options.max_bulge = std::max(kBulges * *options.hausd, cut.needed_bulge());
}

}  // namespace

bool is_grid(const std::filesystem::path& file) { return file.extension() == ".vdb"; }

GridCut cut_by_grid(const RemeshArguments& arguments, Options& options) {
  const ImplicitArguments& implicit = *arguments.implicit;
  const auto grid =
      std::make_shared<const Grid>(arguments.input, GridChoice{implicit.grid, implicit.isovalue});
  const LevelSet level_set{[grid](const Vec3& p) { return grid->value(p); },
                           [grid](const Vec3& p) { return grid->gradient(p); }};
  const Box box = domain(implicit, *grid);
  set_hausd(box, options);
  CutOptions cut_options = to_cut_options(implicit);
  cut_options.isovalue = 0;  // the grid's values are less its isovalue
  try {
    const RefineOptions refine{kChordShare * *options.hausd,
                               std::max(grid->voxel(), options.hmin.value_or(0))};
    GridCut cut{mesh_level_set(box, level_set, grid->zeros(), refine, cut_options), level_set};
    set_bulge(cut.result.report, options);
    return cut;
  } catch (const InputError& e) {
    throw InputError(arguments.input + ": " + e.what());
  }
}

}  // namespace cavea::program
