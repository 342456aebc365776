#include "cavea/vdb/grid.h"

#include "cavea/base/error.h"
#include "cavea/base/module.h"
#include "cavea/vdb/backend.h"

namespace cavea {
namespace {

const VdbBackend& backend() {
#ifdef CAVEA_HAVE_OPENVDB
  static const auto* const opened =
      static_cast<const VdbBackend*>(module_symbol("cavea_openvdb", "cavea_vdb_backend"));
  return *opened;
#else
  throw OptionError("this build is without OpenVDB");
#endif
}

}  // namespace

Grid::Grid(const std::filesystem::path& file, const GridChoice& choice)
    : source_(backend().open_grid(file, choice)) {}
Grid::Grid(Grid&&) noexcept = default;
Grid::~Grid() = default;
double Grid::value(const Vec3& p) const { return source_->value(p); }
Vec3 Grid::gradient(const Vec3& p) const { return source_->gradient(p); }
double Grid::voxel() const { return source_->voxel; }
const Box& Grid::bounds() const { return source_->bounds; }
bool Grid::is_open() const { return source_->open; }
const std::vector<OrientedPoint>& Grid::zeros() const { return source_->zeros; }

void write_sample_grid(const std::filesystem::path& file, const SampleShape& shape,
                       const GridSettings& settings) {
  backend().write_sample_grid(file, shape, settings);
}

void write_surface_grid(const std::filesystem::path& file, const SurfaceTriangles& surface,
                        const GridSettings& settings) {
  backend().write_surface_grid(file, surface, settings);
}

}  // namespace cavea
