#pragma once
// Between what is always there and the module that brings OpenVDB along.
#include "cavea/vdb/grid.h"
#include "cavea/vdb/sample_grids.h"

namespace cavea {

/// What a grid of any type of values offers.
struct GridSource {
  virtual ~GridSource() = default;
  virtual double value(const Vec3& p) const = 0;
  /// The place nearest to p that is `voxels` voxels inside of the bounds.
  virtual Vec3 inside(const Vec3& p, int voxels) const = 0;

  Vec3 gradient(const Vec3& p) const {
    const double h = voxel;
    const Vec3 at = inside(p, 1);
    const auto slope = [&](const Vec3& e) { return (value(at + e) - value(at - e)) / (2 * h); };
    return {slope({h, 0, 0}), slope({0, h, 0}), slope({0, 0, h})};
  }

  double voxel = 0;
  Box bounds;
  bool open = false;
  std::vector<OrientedPoint> zeros;
};

/// The functions of the module cavea_openvdb, which has one of these as its symbol
/// `cavea_vdb_backend`. They throw what the public ones do.
struct VdbBackend {
  std::unique_ptr<const GridSource> (*open_grid)(const std::filesystem::path&, const GridChoice&);
  decltype(&cavea::write_sample_grid) write_sample_grid;
  decltype(&cavea::write_surface_grid) write_surface_grid;
};

namespace openvdb_module {

std::unique_ptr<const GridSource> open_grid(const std::filesystem::path& file,
                                            const GridChoice& choice);
void write_sample_grid(const std::filesystem::path& file, const SampleShape& shape,
                       const GridSettings& settings);
void write_surface_grid(const std::filesystem::path& file, const SurfaceTriangles& surface,
                        const GridSettings& settings);

}  // namespace openvdb_module
}  // namespace cavea
