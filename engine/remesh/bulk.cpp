#include "cavea/remesh/bulk.h"

#include <algorithm>
#include <utility>

#include "cavea/base/ids_where.h"
#include "cavea/geometry/metric.h"
#include "cavea/subdivide/contract.h"
#include "cavea/subdivide/subdivide.h"
#include "cavea/surface/midpoint.h"

namespace cavea {
namespace {

/// Edges at least this long in the metric are halved: what is left is for splits one by one, which
/// choose better. Those inside are left to seeds first, and only longer ones then.
constexpr double kLongOnSurface = 2.0, kLongAnywhere = 2.6;
/// A level is worth its cost when this share of the surface triangles, or of the tets, would be
/// divided.
constexpr double kWorthwhile = 0.02;
constexpr int kMostLevels = 16;

/// What is contracted in bulk: vertices inside at edges as short as those that are collapsed while
/// thinning, which comes next and mends what is poor. Where fewer of them would go, thinning does
/// as well and chooses better.
constexpr ContractionLimits kContraction{
    .short_edge = 0.6, .long_edge = kLongEdge, .least_quality = 0.01, .worthwhile = 0.4};

bool is_long(const TetMesh& m, VertexId a, VertexId b, double most) {
  const Tag both = Tag(m.vertex_tags[a] & m.vertex_tags[b]);
  if (both & tag::kOnRequiredEdge) return false;
  return metric_length(distance(m.points[a], m.points[b]), m.sizes[a], m.sizes[b]) > most;
}

/// Whether the edge opposite corner k of a surface triangle is to be halved. Where the volume
/// touches itself, all is left as it is.
bool is_long(const TetMesh& m, const Triangle& t, std::size_t k, double most) {
  return !((t.tags | t.edge_tag[k]) & tag::kRequired) && !(t.edge_tag[k] & tag::kPinched) &&
         is_long(m, t.v[(k + 1) % 3], t.v[(k + 2) % 3], most);
}

bool has_long_edge(const TetMesh& m, const Triangle& t) {
  return is_long(m, t, 0, kLongOnSurface) || is_long(m, t, 1, kLongOnSurface) ||
         is_long(m, t, 2, kLongOnSurface);
}

bool has_long_edge(const TetMesh& m, const std::array<VertexId, 4>& t) {
  return std::ranges::any_of(
      kEdgeVertices, [&](const auto& e) { return is_long(m, t[e[0]], t[e[1]], kLongAnywhere); });
}

/// Of triangles or tets, those with a long edge.
template <class Item>
double share_to_divide(const TetMesh& m, const std::vector<Item>& items) {
  if (items.empty()) return 0;
  const std::int64_t long_ones = count_where(
      items.size(), [&](std::int32_t i) { return has_long_edge(m, items[std::size_t(i)]); });
  return double(long_ones) / double(items.size());
}

/// Whether so much is long that a level of subdivision is worth its cost.
bool is_worth_bulk(const TetMesh& mesh, BulkEdges which) {
  return (which == BulkEdges::kOfSurface ? share_to_divide(mesh, mesh.triangles)
                                         : share_to_divide(mesh, mesh.tets)) > kWorthwhile;
}

}  // namespace

std::optional<TetMesh> coarsened_in_bulk(const TetMesh& mesh, const std::atomic<bool>* cancel) {
  std::optional<TetMesh> coarse;
  for (auto next = contracted(mesh, kContraction, cancel); next;
       next = contracted(*coarse, kContraction, cancel))
    coarse = std::move(next);
  return coarse;
}

std::optional<TetMesh> refine_in_bulk(TetMesh& mesh, const SurfaceModel& surface, BulkEdges which,
                                      const std::function<void()>& resize) {
  auto halved = [&](const MeshEdge& e) {
    if (e.triangle != kNone)
      return is_long(mesh, mesh.triangles[e.triangle], std::size_t(e.side), kLongOnSurface);
    return which == BulkEdges::kAll && is_long(mesh, e.a, e.b, kLongAnywhere);
  };
  std::optional<TetMesh> before;
  for (int level = 0; level < kMostLevels && is_worth_bulk(mesh, which); ++level) {
    TetMesh finer = subdivide(mesh, halved, [&](const MeshEdge& e) {
      return midpoint(mesh, surface, e.a, e.b, e.triangle, e.side);
    });
    if (!before) before = std::move(mesh);
    mesh = std::move(finer);
    resize();
  }
  return before;
}

}  // namespace cavea
