#include "cavea/remesh/bulk.h"

#include "cavea/base/parallel.h"
#include "cavea/geometry/metric.h"
#include "cavea/subdivide/subdivide.h"
#include "cavea/surface/midpoint.h"

namespace cavea {
namespace {

/// Edges at least this long in the metric are halved: what is left is for splits one by one, which
/// choose better.
constexpr double kBulkEdge = 2.0;
/// A level is worth its cost when this share of the surface triangles would be divided.
constexpr double kWorthwhile = 0.02;
constexpr int kMostLevels = 16;

bool is_long(const TetMesh& m, VertexId a, VertexId b) {
  const Tag both = Tag(m.vertex_tags[a] & m.vertex_tags[b]);
  if (both & tag::kOnRequiredEdge) return false;
  return metric_length(distance(m.points[a], m.points[b]), m.sizes[a], m.sizes[b]) > kBulkEdge;
}

/// Whether the edge opposite corner k of a surface triangle is to be halved.
bool halved(const TetMesh& m, const Triangle& t, std::size_t k) {
  return !((t.tags | t.edge_tag[k]) & tag::kRequired) &&
         is_long(m, t.v[(k + 1) % 3], t.v[(k + 2) % 3]);
}

double share_to_divide(const TetMesh& m) {
  const auto long_ones = parallel_reduce(
      m.triangles.size(), std::int64_t{0},
      [&](std::size_t begin, std::size_t end) {
        std::int64_t n = 0;
        for (std::size_t i = begin; i < end; ++i) {
          const Triangle& t = m.triangles[i];
          n += halved(m, t, 0) || halved(m, t, 1) || halved(m, t, 2);
        }
        return n;
      },
      [](std::int64_t a, std::int64_t b) { return a + b; });
  return m.triangles.empty() ? 0 : double(long_ones) / double(m.triangles.size());
}

}  // namespace

int refine_in_bulk(TetMesh& mesh, const SurfaceModel& surface,
                   const std::function<void()>& resize) {
  int level = 0;
  for (; level < kMostLevels && share_to_divide(mesh) > kWorthwhile; ++level) {
    mesh = subdivide(
        mesh,
        [&](const MeshEdge& e) {
          return e.triangle != kNone &&
                 halved(mesh, mesh.triangles[e.triangle], std::size_t(e.side));
        },
        [&](const MeshEdge& e) { return midpoint(mesh, surface, e.a, e.b, e.triangle, e.side); });
    resize();
  }
  return level;
}

}  // namespace cavea
