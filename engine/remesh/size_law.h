#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "cavea/field/size_field.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The wanted sizes inside the volume, where the mesh does not yet have vertices that know them.
struct SizeLaw {
  double hmin = 0, hmax = 0;
  double hgrad = 1;  ///< infinity for no bound
  double scale = 1;  ///< of what the field asks for
  SizeField field;

  /// Of the wanted size with the distance.
  double growth() const {
    return std::isfinite(hgrad) ? std::log(hgrad) : std::numeric_limits<double>::max();
  }
  /// At a point, given a bound that the vertices around it impose.
  double bounded(const Vec3& p, double bound) const {
    const double most = std::min(bound, hmax);
    return field ? std::max(hmin, std::min(most, scale * field(p))) : most;
  }
  /// At a point of a tet. \pre its vertices' sizes are known
  double at(const TetMesh& mesh, TetId t, const Vec3& p) const {
    double bound = std::numeric_limits<double>::infinity();
    for (const VertexId v : mesh.tets[t]) {
      const double way = distance(mesh.points[v], p);
      bound = std::min(bound, mesh.sizes[v] + (way > 0 ? growth() * way : 0));
    }
    return bounded(p, bound);
  }
};

}  // namespace cavea
