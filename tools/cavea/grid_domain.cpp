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

/// The grids in which something is to be meshed, by priority.
struct NamedGrid {
  std::string name;
  std::shared_ptr<const Grid> grid;
};

/// One of each file, or several of one. \throw InputError, OptionError
std::vector<NamedGrid> read_grids(const std::string& first, const ImplicitArguments& implicit) {
  std::vector<std::string> files = {first}, names = implicit.grids;
  files.insert(files.end(), implicit.below.begin(), implicit.below.end());
  if (files.size() == 1) files.resize(std::max<std::size_t>(1, names.size()), first);
  if (names.empty()) names.resize(files.size());
  if (names.size() != files.size())
    throw OptionError(fmt::format("--grid is given {} times for {} files: once for each, or never",
                                  names.size(), files.size()));
  std::vector<NamedGrid> grids;
  for (std::size_t k = 0; k < files.size(); ++k)
    grids.push_back(
        {files.size() == 1 || names[k].empty() ? files[k]
                                               : fmt::format("{}: grid '{}'", files[k], names[k]),
         std::make_shared<const Grid>(files[k], GridChoice{names[k], implicit.isovalue})});
  return grids;
}

/// The box of --box. \throw OptionError if it is none, or does not meet the grids'
Box given_box(const std::vector<double>& v, const Box& of_grids) {
  const Box box{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  if (!(is_finite(box.low) && is_finite(box.high) && v[0] < v[3] && v[1] < v[4] && v[2] < v[5]))
    throw OptionError("--box must have its low corner below its high one along each axis");
  if (!box.overlaps(of_grids))
    throw OptionError(fmt::format("--box {} is outside of the grid, which is from {}", text(box),
                                  text(of_grids)));
  return box;
}

/// An open level set ends with the grid; around closed ones there is room.
Box domain(const ImplicitArguments& implicit, const std::vector<NamedGrid>& grids) {
  Box box;
  bool open = false;
  for (const auto& [name, grid] : grids) {
    box.add(grid->bounds().low);
    box.add(grid->bounds().high);
    open |= grid->is_open();
  }
  if (!implicit.box.empty()) return given_box(implicit.box, box);
  if (open) return box;
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

/// Less than what remesh() would set where voxels are smaller than that: creases of a grid are
/// about a voxel wide, and what is left of them with longer edges can be more than a voxel off.
void set_hmin(const Box& box, const std::vector<NamedGrid>& grids, Options& options) {
  constexpr double kHmin = 0.001, kVoxels = 0.5;
  // A region may ask for less than any hmin that nobody gave.
  if (options.hmin || options.hsiz || !options.size_regions.empty()) return;
  double least = kHmin * distance(box.low, box.high);
  for (const auto& [name, grid] : grids) least = std::min(least, kVoxels * grid->voxel());
  options.hmin = std::min(least, options.hmax.value_or(least));
}

/// What remesh() would set, but more where voxels do not allow chords as short as that: the smooth
/// surface is to reach from the cut's triangles to the level set.
void set_bulge(const std::vector<CutReport>& cuts, Options& options) {
  constexpr double kBulges = 3;
  if (options.max_bulge || options.faceted) return;
  options.max_bulge = kBulges * *options.hausd;
  for (const CutReport& cut : cuts)
    options.max_bulge = std::max(*options.max_bulge, cut.needed_bulge());
}

StackedLevelSet stacked(const NamedGrid& named, const Options& options) {
  const std::shared_ptr<const Grid> grid = named.grid;
  return {{[grid](const Vec3& p) { return grid->value(p); },
           [grid](const Vec3& p) { return grid->gradient(p); }},
          grid->zeros(),
          {kChordShare * *options.hausd, std::max(grid->voxel(), options.hmin.value_or(0))},
          named.name};
}

}  // namespace

bool is_grid(const std::filesystem::path& file) { return file.extension() == ".vdb"; }

GridCut cut_by_grids(const RemeshArguments& arguments, Options& options) {
  const ImplicitArguments& implicit = *arguments.implicit;
  CutOptions cut_options = to_cut_options(implicit);
  cut_options.isovalue = 0;  // the grids' values are less their isovalue
  const std::vector<NamedGrid> grids = read_grids(arguments.input, implicit);
  const Box box = domain(implicit, grids);
  set_hausd(box, options);
  std::vector<StackedLevelSet> stack;
  for (const NamedGrid& named : grids) stack.push_back(stacked(named, options));
  set_hmin(box, grids, options);
  StackResult cut = mesh_level_sets(box, stack, cut_options);
  set_bulge(cut.reports, options);
  GridCut out{std::move(cut.mesh), {}};
  for (std::size_t k = 0; k < stack.size(); ++k)
    out.level_sets.push_back(
        {stack[k].name, cut.reports[k],
         MeshedLevelSet{std::move(stack[k].level_set), interface_ref(cut_options, k)}});
  return out;
}

}  // namespace cavea::program
