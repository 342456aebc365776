#include "cavea/implicit/mesh_level_set.h"

#include <algorithm>

#include "cavea/implicit/box_mesh.h"
#include "cavea/implicit/clear.h"
#include "cavea/mesh/build.h"

namespace cavea {

CutResult mesh_level_set(const Box& box, const LevelSet& level_set,
                         std::span<const OrientedPoint> zeros, const RefineOptions& refine,
                         const CutOptions& cut) {
  constexpr double kLattice = 64;
  // Vertices that are put onto the level set make chords longer.
  constexpr double kClearing = 2;
  // Those that are moved away from it may leave it too coarse.
  constexpr int kMostClearings = 2;
  TetMesh mesh = build(box_mesh(box)).mesh;
  const Vec3 side = box.high - box.low;
  const LevelSet shifted = with_gradient(less(level_set, cut.isovalue), norm(side));
  std::vector<OrientedPoint> found;
  if (zeros.empty()) {
    found = zeros_on_lattice(shifted, box, std::max({side.x, side.y, side.z}) / kLattice);
    zeros = found;
  }
  refine_near(mesh, shifted, zeros, refine);
  const RefineOptions again{kClearing * refine.tolerance, refine.shortest};
  for (int k = 0; k < kMostClearings; ++k) {
    clear_for_cut(mesh, shifted, again.tolerance);
    if (refine_near(mesh, shifted, zeros, again) == 0) break;
  }
  return cut_along(mesh, level_set, cut);
}

}  // namespace cavea
