#include "cavea/remesh/bulk.h"

#include <algorithm>

#include "cavea/base/parallel.h"
#include "cavea/geometry/metric.h"
#include "cavea/subdivide/subdivide.h"
#include "cavea/surface/midpoint.h"

namespace cavea {
namespace {

/// Edges at least this long in the metric are halved: what is left is for splits one by one, which
/// choose better.
constexpr double kBulkEdge = 2.0;
/// A level is worth its cost when this share of the tets would be divided.
constexpr double kWorthwhile = 0.02;
constexpr int kMostLevels = 16;

bool is_long(const TetMesh& m, VertexId a, VertexId b) {
  const Tag both = Tag(m.vertex_tags[a] & m.vertex_tags[b]);
  if (both & tag::kOnRequiredEdge) return false;
  return metric_length(distance(m.points[a], m.points[b]), m.sizes[a], m.sizes[b]) > kBulkEdge;
}

bool on_surface(const TetMesh& m, VertexId a, VertexId b) {
  return m.vertex_tags[a] & m.vertex_tags[b] & tag::kSurface;
}

double share_to_divide(const TetMesh& m) {
  const auto long_ones = parallel_reduce(
      m.tets.size(), std::int64_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::int64_t n = 0;
        for (std::size_t t = begin; t < end; ++t)
          n += std::ranges::any_of(kEdgeVertices, [&](const auto& e) {
            const VertexId a = m.tets[t][e[0]], b = m.tets[t][e[1]];
            return on_surface(m, a, b) && is_long(m, a, b);
          });
        return n;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
  return double(long_ones) / double(m.tets.size());
}

}  // namespace

int refine_in_bulk(TetMesh& mesh, const SurfaceModel& surface,
                   const std::function<void()>& resize) {
  int level = 0;
  for (; level < kMostLevels && share_to_divide(mesh) > kWorthwhile; ++level) {
    auto halved = [&](const MeshEdge& e) {
      if (e.triangle == kNone) return false;
      const Triangle& t = mesh.triangles[e.triangle];
      const bool required = (t.tags | t.edge_tag[std::size_t(e.side)]) & tag::kRequired;
      return !required && is_long(mesh, e.a, e.b);
    };
    mesh = subdivide(mesh, halved, [&](const MeshEdge& e) {
      return midpoint(mesh, surface, e.a, e.b, e.triangle, e.side);
    });
    resize();
  }
  return level;
}

}  // namespace cavea
