#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/vdb/backend.h"
#include "cavea/vdb/open_file.h"

namespace cavea::openvdb_module {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::Vec3d;

constexpr int kBlock = 8;  ///< voxels along a side of a leaf of OpenVDB's trees

Vec3 to_vec3(const Vec3d& p) { return {p.x(), p.y(), p.z()}; }
Vec3d from_vec3(const Vec3& p) { return {p.x, p.y, p.z}; }

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw InputError(file + ": " + why);
}

/// The name of the grid to read. \throw InputError
std::string choose(openvdb::io::File& file, const std::string& path, const std::string& wanted) {
  std::vector<std::string> names;
  for (auto name = file.beginName(); name != file.endName(); ++name) names.push_back(*name);
  if (names.empty()) refuse(path, "holds no grid");
  if (wanted.empty() && names.size() == 1) return names[0];
  if (wanted.empty())
    refuse(path, fmt::format("holds several grids, of which one must be named: {}",
                             fmt::join(names, ", ")));
  if (std::ranges::find(names, wanted) == names.end())
    refuse(path, fmt::format("holds no grid named '{}', but: {}", wanted, fmt::join(names, ", ")));
  return wanted;
}

openvdb::GridBase::Ptr read_grid(const std::filesystem::path& path, const std::string& wanted,
                                 std::string& name) {
  return with_openvdb_errors<InputError>(path, "cannot be read", [&] {
    openvdb::io::File file(path.string());
    file.open(false);  // at once: a file that is cut short is to be found out here
    name = choose(file, path.string(), wanted);
    return file.readGrid(name);
  });
}

/// What is found in one block of voxels.
struct BlockFindings {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  std::optional<Coord> bad;  ///< a voxel whose value is not finite
  bool open = false;
  std::vector<OrientedPoint> zeros;
};

template <class GridType>
class TypedSource final : public GridSource {
 public:
  using Tree = typename GridType::TreeType;
  /// One for each call, which does not register with the tree: accessors are not to be shared.
  using Accessor = openvdb::tree::ValueAccessor<const Tree, false>;

  TypedSource(typename GridType::ConstPtr grid, const std::string& what,
              const std::optional<double>& isovalue)
      : grid_(grid), what_(what), fog_(grid->getGridClass() == openvdb::GRID_FOG_VOLUME) {
    constexpr double kFogSurface = 0.5;  // halfway between empty and full
    iso_ = isovalue.value_or(fog_ ? kFogSurface : 0);
    if (grid_->activeVoxelCount() == 0) refuse(what_, "has no active voxels");
    active_ = grid_->evalActiveVoxelBoundingBox();
    if (fog_) active_.expand(1);  // what is not active is empty, not unknown
    const Vec3d size = grid_->voxelSize();
    voxel = std::min({size.x(), size.y(), size.z()});
    const std::array corners = {active_.min(), active_.max()};
    for (int k = 0; k < 8; ++k)
      bounds.add(to_vec3(grid_->indexToWorld(
          Vec3d(corners[k & 1].x(), corners[k >> 1 & 1].y(), corners[k >> 2].z()))));
    search();
  }

  double value(const Vec3& p) const override {
    // Beyond the bounds, values of the background say nothing.
    const Vec3d at = clamped(grid_->worldToIndex(from_vec3(p)), 0);
    const Accessor accessor(grid_->tree());
    return signed_value(openvdb::tools::BoxSampler::sample(accessor, at));
  }

  Vec3 inside(const Vec3& p, int voxels) const override {
    return to_vec3(grid_->indexToWorld(clamped(grid_->worldToIndex(from_vec3(p)), voxels)));
  }

 private:
  /// An index, moved into the box of active voxels, or its middle where that is too narrow.
  Vec3d clamped(Vec3d at, int voxels) const {
    for (int k = 0; k < 3; ++k) {
      const double low = active_.min()[k], high = active_.max()[k];
      const double margin = std::min<double>(voxels, (high - low) / 2);
      at[k] = std::clamp(at[k], low + margin, high - margin);
    }
    return at;
  }

  double signed_value(double x) const { return fog_ ? iso_ - x : x - iso_; }

  /// Looks at all voxels near active ones, block by block. \throw InputError
  void search() {
    const std::vector<Coord> blocks = find_blocks();
    std::vector<BlockFindings> found(blocks.size());
    parallel_for(
        blocks.size(), [&](std::size_t b) { found[b] = look_at(blocks[b]); }, 16);
    BlockFindings all;
    for (BlockFindings& f : found) {
      if (f.bad)
        refuse(what_, fmt::format("the value of voxel ({}, {}, {}) is not finite", f.bad->x(),
                                  f.bad->y(), f.bad->z()));
      all.least = std::min(all.least, f.least);
      all.most = std::max(all.most, f.most);
      all.open |= f.open;
      all.zeros.insert(all.zeros.end(), f.zeros.begin(), f.zeros.end());
    }
    if (all.zeros.empty())
      refuse(what_,
             fmt::format("is nowhere {}: its values are from {} to {}", iso_, all.least, all.most));
    open = all.open;
    zeros = std::move(all.zeros);
  }

  /// The first voxels of blocks that hold all there is to see: leaves, and the outer layer of what
  /// active tiles stand for. Rising, each once.
  std::vector<Coord> find_blocks() const {
    std::vector<Coord> blocks;
    for (auto leaf = grid_->tree().cbeginLeaf(); leaf; ++leaf) blocks.push_back(leaf->origin());
    for (auto tile = grid_->cbeginValueOn(); tile; ++tile) {
      if (tile.isVoxelValue()) continue;
      CoordBBox box;
      tile.getBoundingBox(box);
      add_shell(box, blocks);
    }
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    return blocks;
  }

  static void add_shell(const CoordBBox& box, std::vector<Coord>& blocks) {
    const Coord last = box.max().offsetBy(1 - kBlock);
    for (int x = box.min().x(); x <= last.x(); x += kBlock)
      for (int y = box.min().y(); y <= last.y(); y += kBlock) {
        const bool side =
            x == box.min().x() || x == last.x() || y == box.min().y() || y == last.y();
        const int step = side ? kBlock : std::max(kBlock, last.z() - box.min().z());
        for (int z = box.min().z(); z <= last.z(); z += step) blocks.emplace_back(x, y, z);
      }
  }

  /// The values of a block and of one more layer on each side.
  class Layered {
   public:
    static constexpr int kSide = kBlock + 2;

    Layered(const Tree& tree, const Coord& first) {
      const Accessor accessor(tree);
      for (int k = 0; k < kSide * kSide * kSide; ++k)
        values_[k] = accessor.getValue(
            first.offsetBy(k % kSide - 1, k / kSide % kSide - 1, k / (kSide * kSide) - 1));
    }
    /// x, y, z from -1 to kBlock, from the block's first voxel.
    double operator()(int x, int y, int z) const {
      return values_[((z + 1) * kSide + y + 1) * kSide + x + 1];
    }

   private:
    std::array<double, kSide * kSide * kSide> values_;
  };

  BlockFindings look_at(const Coord& first) const {
    const Layered values(grid_->tree(), first);
    BlockFindings found;
    for (int z = 0; z < kBlock; ++z)
      for (int y = 0; y < kBlock; ++y)
        for (int x = 0; x < kBlock; ++x) {
          const double value = values(x, y, z);
          if (!std::isfinite(value)) found.bad = first.offsetBy(x, y, z);
          found.least = std::min(found.least, value);
          found.most = std::max(found.most, value);
        }
    // Cells begin at odd voxels in the block before: the first ones are its own, and are seen
    // twice if it is looked at, too, which does no harm.
    for (int z = -1; z < kBlock; z += 2)
      for (int y = -1; y < kBlock; y += 2)
        for (int x = -1; x < kBlock; x += 2) look_at_cells(first, values, {x, y, z}, found);
    return found;
  }

  /// Of two cells along each axis the first that has both signs gives a zero.
  void look_at_cells(const Coord& first, const Layered& values, const Coord& from,
                     BlockFindings& found) const {
    for (int k = 0; k < 8; ++k) {
      const Coord cell = from.offsetBy(k & 1, k >> 1 & 1, k >> 2);
      if (std::max({cell.x(), cell.y(), cell.z()}) >= kBlock || !is_crossed(values, cell)) continue;
      const Coord at = first + cell;
      if (!active_.isInside(at) || !active_.isInside(at.offsetBy(1))) {
        found.open = true;
        continue;
      }
      found.zeros.push_back(zero_in(at));
      return;
    }
  }

  bool is_crossed(const Layered& values, const Coord& cell) const {
    int inside = 0;
    for (int k = 0; k < 8; ++k)
      inside += signed_value(
                    values(cell.x() + (k & 1), cell.y() + (k >> 1 & 1), cell.z() + (k >> 2))) < 0;
    return inside != 0 && inside != 8;
  }

  /// One step from the middle of a cell, which is nearer than a voxel, along the slope.
  OrientedPoint zero_in(const Coord& cell) const {
    const Vec3 middle = to_vec3(grid_->indexToWorld(cell.asVec3d() + Vec3d(0.5)));
    const Vec3 slope = gradient(middle);
    const Vec3 step = slope * (-value(middle) / norm2(slope));
    const bool near = is_finite(step) && norm(step) < voxel;
    return {near ? middle + step : middle, normalized(slope)};
  }

  typename GridType::ConstPtr grid_;
  std::string what_;
  bool fog_;
  double iso_ = 0;
  CoordBBox active_;
};

}  // namespace

std::unique_ptr<const GridSource> open_grid(const std::filesystem::path& file,
                                            const GridChoice& choice) {
  if (choice.isovalue && !std::isfinite(*choice.isovalue))
    throw OptionError(fmt::format("the isovalue must be finite, not {}", *choice.isovalue));
  std::string name;
  const openvdb::GridBase::Ptr grid = read_grid(file, choice.name, name);
  const std::string what = fmt::format("{}: grid '{}'", file.string(), name);
  const auto take = [&](const auto& typed) -> std::unique_ptr<const GridSource> {
    using Type = typename std::decay_t<decltype(*typed)>;
    return std::make_unique<const TypedSource<Type>>(typed, what, choice.isovalue);
  };
  if (const auto floats = openvdb::gridPtrCast<openvdb::FloatGrid>(grid)) return take(floats);
  if (const auto doubles = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid)) return take(doubles);
  refuse(what, fmt::format("is of type {}; only grids of float and double can be used",
                           grid->valueType()));
}

}  // namespace cavea::openvdb_module
