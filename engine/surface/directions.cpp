#include "cavea/surface/directions.h"

#include <utility>

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

/// The unit vectors of direction(v) in the order of the vertices, without those that are zero.
template <class Direction>
void collect(const TetMesh& mesh, Direction&& direction, std::vector<Vec3>& vectors,
             std::vector<std::array<std::int32_t, 2>>& at_vertices) {
  std::vector<Vec3> all(mesh.points.size());
  parallel_for(all.size(), [&](std::size_t v) { all[v] = direction(VertexId(v)); });
  for (std::size_t v = 0; v < all.size(); ++v) {
    if (norm2(all[v]) == 0) continue;
    at_vertices.push_back({VertexId(v), std::int32_t(vectors.size())});
    vectors.push_back(all[v]);
  }
}

}  // namespace

SurfaceDirections surface_directions(const TetMesh& mesh, const SurfaceModel& surface) {
  constexpr Tag kNoNormal = tag::kCorner | tag::kRidge | tag::kNonManifold | tag::kPinched;
  const std::vector<std::int32_t> patch = patch_of_vertices(mesh);
  SurfaceDirections out;
  const auto normal = [&](VertexId v) {
    if (patch[v] == kNone || (mesh.vertex_tags[v] & kNoNormal)) return Vec3{};
    return surface.normal(mesh.anchors[v], patch[v]);
  };
  const auto tangent = [&](VertexId v) {
    if (patch[v] == kNone || (mesh.vertex_tags[v] & tag::kCorner) ||
        !SurfaceModel::is_curve(mesh.anchors[v]))
      return Vec3{};
    return surface.tangent(mesh.anchors[v]);
  };
  collect(mesh, normal, out.normals, out.normal_at_vertices);
  collect(mesh, tangent, out.tangents, out.tangent_at_vertices);
  return out;
}

void add_directions(SurfaceDirections&& directions, MeshData& data) {
  data.normals = std::move(directions.normals);
  data.normal_at_vertices = std::move(directions.normal_at_vertices);
  data.tangents = std::move(directions.tangents);
  data.tangent_at_vertices = std::move(directions.tangent_at_vertices);
}

}  // namespace cavea
