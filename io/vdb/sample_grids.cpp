#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/vdb/backend.h"
#include "cavea/vdb/open_file.h"

namespace cavea::openvdb_module {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;

constexpr int kBlock = 8;  ///< voxels along a side of a leaf of OpenVDB's trees

void check(const GridSettings& settings) {
  if (settings.voxels < kBlock)
    throw OptionError(fmt::format("a grid needs at least {} voxels along its longest side, not {}",
                                  kBlock, settings.voxels));
  // Trilinear values and central differences at the zero need two voxels on either side.
  if (!(settings.half_width >= 2))
    throw OptionError(fmt::format("the band must be at least 2 voxels wide on either side, not {}",
                                  settings.half_width));
}

double longest_side(const Box& box) {
  const Vec3 side = box.high - box.low;
  return std::max({side.x, side.y, side.z});
}

/// OpenVDB gives each file a random identifier, in its header as text. The same grid is to be the
/// same bytes: it becomes that of no file.
void clear_identifier(const std::filesystem::path& path) {
  constexpr std::streamoff kPlace = 21;  // after the magic number, three versions and a flag
  const std::string none = "00000000-0000-0000-0000-000000000000";
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  std::string found(none.size(), '\0');
  file.seekg(kPlace).read(found.data(), std::streamsize(found.size()));
  for (std::size_t k = 0; k < none.size(); ++k)
    if ((found[k] == '-') != (none[k] == '-')) return;  // another version's header: as it is
  file.seekp(kPlace).write(none.data(), std::streamsize(none.size()));
  if (!file.flush()) throw OutputError(path.string() + ": cannot be written");
}

void write(const std::filesystem::path& file, const FloatGrid::Ptr& grid,
           const GridSettings& settings) {
  grid->setName(settings.name);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  with_openvdb_errors<OutputError>(file, "cannot be written", [&] {
    openvdb::io::File out(file.string());
    out.write({grid});
    out.close();
  });
  clear_identifier(file);
}

/// Samples a function block by block: evaluated where the band may be, a tile elsewhere.
class Sampling {
 public:
  Sampling(const SampleShape& shape, const GridSettings& settings)
      : shape_(shape),
        voxel_(longest_side(shape.box) / settings.voxels),
        band_(settings.half_width * voxel_),
        grid_(FloatGrid::create(float(band_))),
        accessor_(grid_->getAccessor()) {
    grid_->setTransform(openvdb::math::Transform::createLinearTransform(voxel_));
  }

  FloatGrid::Ptr run() {
    const auto index = [&](double x) { return int(std::floor(x / voxel_)) & ~(kBlock - 1); };
    const Vec3 &low = shape_.box.low, &high = shape_.box.high;
    for (int x = index(low.x); x <= high.x / voxel_; x += kBlock)
      for (int y = index(low.y); y <= high.y / voxel_; y += kBlock)
        for (int z = index(low.z); z <= high.z / voxel_; z += kBlock) sample({x, y, z});
    grid_->pruneGrid();
    return grid_;
  }

 private:
  Vec3 place(const Coord& at) const { return {at.x() * voxel_, at.y() * voxel_, at.z() * voxel_}; }

  void sample(const Coord& first) {
    const double middle =
        shape_.value(place(first) + Vec3{1, 1, 1} * ((kBlock - 1) / 2.0 * voxel_));
    const double reach = shape_.steepest * std::sqrt(3.0) * (kBlock - 1) / 2.0 * voxel_ + band_;
    if (middle > reach) return;
    if (middle < -reach)
      grid_->tree().addTile(1, first, float(-band_), false);
    else
      sample_voxels(first);
  }

  void sample_voxels(const Coord& first) {
    for (int x = 0; x < kBlock; ++x)
      for (int y = 0; y < kBlock; ++y)
        for (int z = 0; z < kBlock; ++z) sample_voxel(first.offsetBy(x, y, z));
  }

  void sample_voxel(const Coord& at) {
    // Not beyond the box: there, the level set is open.
    constexpr double kRounding = 1e-6;  // of a voxel
    const Vec3 p = place(at), low = shape_.box.low, high = shape_.box.high;
    for (int k = 0; k < 3; ++k)
      if (p[k] < low[k] - kRounding * voxel_ || p[k] > high[k] + kRounding * voxel_) return;
    const double value = shape_.value(p);
    if (std::abs(value) < band_)
      accessor_.setValueOn(at, float(value));
    else
      accessor_.setValueOff(at, float(value < 0 ? -band_ : band_));
  }

  const SampleShape& shape_;
  double voxel_, band_;
  FloatGrid::Ptr grid_;
  FloatGrid::Accessor accessor_;
};

}  // namespace

void write_sample_grid(const std::filesystem::path& file, const SampleShape& shape,
                       const GridSettings& settings) {
  check(settings);
  openvdb::initialize();
  write(file, Sampling(shape, settings).run(), settings);
}

void write_surface_grid(const std::filesystem::path& file, const SurfaceTriangles& surface,
                        const GridSettings& settings) {
  check(settings);
  openvdb::initialize();
  Box box;
  for (const Vec3& p : surface.points) box.add(p);
  const auto transform =
      openvdb::math::Transform::createLinearTransform(longest_side(box) / settings.voxels);
  std::vector<openvdb::Vec3s> points;
  for (const Vec3& p : surface.points) points.emplace_back(float(p.x), float(p.y), float(p.z));
  std::vector<openvdb::Vec3I> triangles;
  for (const auto& t : surface.triangles)
    triangles.emplace_back(std::uint32_t(t[0]), std::uint32_t(t[1]), std::uint32_t(t[2]));
  write(file,
        openvdb::tools::meshToLevelSet<FloatGrid>(*transform, points, triangles,
                                                  float(settings.half_width)),
        settings);
}

}  // namespace cavea::openvdb_module
