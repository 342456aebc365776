#include "cavea/field/wanted_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/field/gradation.h"
#include "cavea/mesh/buckets.h"

namespace cavea {

void set_wanted_sizes(TetMesh& mesh, const std::function<double(const Anchor&)>& curvature_size,
                      const SizeField& field, const SizeBounds& bounds) {
  VertexId senseless = std::numeric_limits<VertexId>::max();  // the smallest one is told
  parallel_for(mesh.points.size(), [&](std::size_t v) {
    double h = bounds.hmax;
    if (mesh.vertex_tags[v] & tag::kSurface) h = std::min(h, curvature_size(mesh.anchors[v]));
    if (field) {
      const double wish = field(mesh.points[v]);
      if (!(wish > 0)) atomic_min(senseless, VertexId(v));
      h = std::min(h, wish);
    }
    mesh.sizes[v] = float(std::clamp(h, bounds.hmin, bounds.hmax));
  });
  if (std::size_t(senseless) < mesh.points.size()) {
    const Vec3& p = mesh.points[senseless];
    throw InputError(fmt::format("the size field is not positive at ({}, {}, {})", p.x, p.y, p.z));
  }
  if (bounds.hmin < bounds.hmax) limit_gradation(mesh, bounds.hgrad);
}

}  // namespace cavea
