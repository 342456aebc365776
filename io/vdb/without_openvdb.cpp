// In place of the other files where OpenVDB is not there.
#include "cavea/base/error.h"
#include "cavea/vdb/grid.h"
#include "cavea/vdb/sample_grids.h"

namespace cavea {
namespace {

[[noreturn]] void refuse() { throw OptionError("this build is without OpenVDB"); }

}  // namespace

struct Grid::Source {};

Grid::Grid(const std::filesystem::path&, const GridChoice&) { refuse(); }
Grid::Grid(Grid&&) noexcept = default;
Grid::~Grid() = default;
double Grid::value(const Vec3&) const { refuse(); }
Vec3 Grid::gradient(const Vec3&) const { refuse(); }
double Grid::voxel() const { refuse(); }
const Box& Grid::bounds() const { refuse(); }
bool Grid::is_open() const { refuse(); }
const std::vector<OrientedPoint>& Grid::zeros() const { refuse(); }

void write_sample_grid(const std::filesystem::path&, const SampleShape&, const GridSettings&) {
  refuse();
}
void write_surface_grid(const std::filesystem::path&, const SurfaceTriangles&,
                        const GridSettings&) {
  refuse();
}

}  // namespace cavea
