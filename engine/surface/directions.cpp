#include "cavea/surface/directions.h"

#include <utility>

#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"

namespace cavea {
namespace {

/// A patch at each surface vertex: of its first triangle.
std::vector<std::int32_t> patch_of_vertices(const TetMesh& mesh) {
  std::vector<std::int32_t> patch(mesh.points.size(), kNone);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t.v)
      if (patch[v] == kNone) patch[v] = t.patch;
  return patch;
}

/// The unit vectors of direction(v) at some vertices, in their order, without those that are zero.
template <class Direction>
void collect(const std::vector<VertexId>& vertices, Direction&& direction,
             std::vector<Vec3>& vectors, std::vector<std::array<std::int32_t, 2>>& at_vertices) {
  std::vector<Vec3> all(vertices.size());
  parallel_for(all.size(), [&](std::size_t i) { all[i] = direction(vertices[i]); });
  vectors.reserve(all.size());
  at_vertices.reserve(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (norm2(all[i]) == 0) continue;
    at_vertices.push_back({vertices[i], std::int32_t(vectors.size())});
    vectors.push_back(all[i]);
  }
}

}  // namespace

SurfaceDirections surface_directions(const TetMesh& mesh, const SurfaceModel& surface) {
  constexpr Tag kNoNormal = tag::kCorner | tag::kRidge | tag::kNonManifold | tag::kPinched;
  const std::vector<std::int32_t> patch = patch_of_vertices(mesh);
  SurfaceDirections out;
  const std::size_t n = mesh.points.size();
  const std::vector<VertexId> with_normal = ids_where(
      n, [&](VertexId v) { return patch[v] != kNone && !(mesh.vertex_tags[v] & kNoNormal); });
  const std::vector<VertexId> with_tangent = ids_where(n, [&](VertexId v) {
    return patch[v] != kNone && !(mesh.vertex_tags[v] & tag::kCorner) &&
           SurfaceModel::is_curve(mesh.anchors[v]);
  });
  run_together(
      [&] {
        collect(
            with_normal, [&](VertexId v) { return surface.normal(mesh.anchors[v], patch[v]); },
            out.normals, out.normal_at_vertices);
      },
      [&] {
        collect(
            with_tangent, [&](VertexId v) { return surface.tangent(mesh.anchors[v]); },
            out.tangents, out.tangent_at_vertices);
      });
  return out;
}

void add_directions(SurfaceDirections&& directions, MeshData& data) {
  data.normals = std::move(directions.normals);
  data.normal_at_vertices = std::move(directions.normal_at_vertices);
  data.tangents = std::move(directions.tangents);
  data.tangent_at_vertices = std::move(directions.tangent_at_vertices);
}

}  // namespace cavea
