#include "cavea/field/wanted_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cavea/base/atomic.h"
#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/field/gradation.h"
#include "cavea/field/local_bounds.h"
#include "cavea/field/own_sizes.h"

namespace cavea {

namespace {

ImposedSizes imposed_on(const TetMesh& mesh, const SizeBounds& bounds) {
  if (!bounds.hgradreq && !bounds.surface_imposes) return {};
  return {required_sizes(mesh, bounds.surface_imposes),
          bounds.hgradreq.value_or(std::numeric_limits<double>::infinity())};
}

double bounded(double size, double hmin, const SizeBounds& bounds) {
  return bounds.scale * std::max(bounds.finer * size, hmin);
}

}  // namespace

SizeRange wished_range(const TetMesh& mesh, const SizeField& field) {
  if (!field) return {};
  return parallel_reduce(
      mesh.points.size(), SizeRange{},
      [&](std::size_t begin, std::size_t end) {
        SizeRange range;
        for (std::size_t v = begin; v < end; ++v)
          if (const double size = field(mesh.points[v]); size > 0) range.add(size);
        return range;
      },
      [](SizeRange a, const SizeRange& b) {
        return SizeRange{std::min(a.smallest, b.smallest), std::max(a.largest, b.largest)};
      });
}

void set_wanted_sizes(TetMesh& mesh, const std::function<double(VertexId)>& curvature_size,
                      const SizeField& field, const SizeBounds& bounds) {
  const VertexBounds at = bounds_of_vertices(mesh, bounds.hmin, bounds.hmax, bounds.local);
  VertexId senseless = std::numeric_limits<VertexId>::max();  // the smallest one is told
  parallel_for(mesh.points.size(), [&](std::size_t v) {
    double h = at.hmax[v];
    if (mesh.vertex_tags[v] & tag::kSurface) h = std::min(h, curvature_size(VertexId(v)));
    if (field) {
      const double wish = field(mesh.points[v]);
      if (!(wish > 0)) atomic_min(senseless, VertexId(v));
      h = std::min(h, wish);
    }
    mesh.sizes[v] = float(bounded(h, at.hmin[v], bounds));
  });
  if (std::size_t(senseless) < mesh.points.size()) {
    const Vec3& p = mesh.points[senseless];
    throw InputError(fmt::format("the size field is not positive at ({}, {}, {})", p.x, p.y, p.z));
  }
  const ImposedSizes imposed = imposed_on(mesh, bounds);
  const bool vary = bounds.hmin < bounds.hmax || !bounds.local.empty();
  if (!imposed.sizes.empty() || (vary && std::isfinite(bounds.hgrad)))
    limit_gradation(mesh, bounds.hgrad, imposed);
}

std::vector<float> lower_wanted_sizes(TetMesh& mesh,
                                      const std::function<double(const Anchor&)>& size,
                                      const SizeBounds& bounds) {
  const VertexBounds at = bounds_of_vertices(mesh, bounds.hmin, bounds.hmax, bounds.local);
  std::vector<float> before = mesh.sizes;
  parallel_for(mesh.points.size(), [&](std::size_t v) {
    if (!(mesh.vertex_tags[v] & tag::kSurface)) return;
    const double h = std::min(double(at.hmax[v]), size(mesh.anchors[v]));
    mesh.sizes[v] = std::min(before[v], float(bounded(h, at.hmin[v], bounds)));
  });
  limit_gradation_of_lowered(mesh, bounds.hgrad, before, imposed_on(mesh, bounds));
  return before;
}

}  // namespace cavea
