#include "grid_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cavea/base/error.h"
#include "cavea/implicit/box_mesh.h"
#include "cavea/implicit/refine.h"
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

RefineOptions refine_options(const Options& options, const Box& box, double voxel) {
  // As in remesh(). Chords of half the tolerance are about as long as it wants its edges.
  constexpr double kDefault = 0.001, kChordShare = 0.5;
  const double diagonal = distance(box.low, box.high);
  return {kChordShare * options.hausd.value_or(kDefault * diagonal),
          std::max(voxel, options.hmin.value_or(0))};
}

}  // namespace

bool is_grid(const std::filesystem::path& file) { return file.extension() == ".vdb"; }

CutReport cut_by_grid(const RemeshArguments& arguments, const Options& options,
                      LoadedMesh& loaded) {
  const ImplicitArguments& implicit = *arguments.implicit;
  const auto grid =
      std::make_shared<const Grid>(arguments.input, GridChoice{implicit.grid, implicit.isovalue});
  const LevelSet level_set{[grid](const Vec3& p) { return grid->value(p); },
                           [grid](const Vec3& p) { return grid->gradient(p); }};
  const Box box = domain(implicit, *grid);
  TetMesh mesh = build(box_mesh(box)).mesh;
  refine_near(mesh, level_set, grid->zeros(), refine_options(options, box, grid->voxel()));
  CutOptions cut_options = to_cut_options(implicit);
  cut_options.isovalue = 0;  // the grid's values are less its isovalue
  try {
    CutResult cut = cut_along(mesh, level_set, cut_options);
    loaded.mesh = std::move(cut.mesh);
    return cut.report;
  } catch (const InputError& e) {
    throw InputError(arguments.input + ": " + e.what());
  }
}

}  // namespace cavea::program
