#include "cavea/field/own_sizes.h"

#include <algorithm>
#include <memory>

#include "cavea/field/mean_lengths.h"
#include "cavea/field/mesh_size_field.h"
#include "cavea/mesh/edge_shares.h"

namespace cavea {
namespace {

template <class F>
void for_each_edge(const TetMesh& m, TetId t, F&& f) {
  for (const auto& e : kEdgeVertices) f(m.tets[t][e[0]], m.tets[t][e[1]]);
}

/// Calls f(a, b) for the required edges of a tet: those inside the volume, known by their ends, and
/// those of its surface triangles.
template <class F>
void for_each_required_edge(const TetMesh& m, TetId t, bool whole_surface, F&& f) {
  for_each_edge(m, t, [&](VertexId a, VertexId b) {
    if (m.vertex_tags[a] & m.vertex_tags[b] & tag::kOnRequiredEdge) f(a, b);
  });
  for (const FaceLink link : m.links[t]) {
    if (!link.is_triangle()) continue;
    const Triangle& s = m.triangles[link.triangle()];
    for (int k = 0; k < 3; ++k)
      if (whole_surface || ((s.tags | s.edge_tag[k]) & tag::kRequired))
        f(s.v[(k + 1) % 3], s.v[(k + 2) % 3]);
  }
}

bool has_required_edges(const TetMesh& m) {
  const auto is_required = [](const Triangle& s) {
    return ((s.tags | s.edge_tag[0] | s.edge_tag[1] | s.edge_tag[2]) & tag::kRequired) != 0;
  };
  return std::ranges::any_of(m.triangles, is_required) ||
         std::ranges::any_of(m.vertex_tags, [](Tag t) { return t & tag::kOnRequiredEdge; });
}

}  // namespace

std::vector<float> mean_edge_lengths(const TetMesh& mesh) {
  return mean_lengths(mesh, [&](TetId t, auto&& f) {
    EdgeShare(mesh, t).for_each([&](const auto& e) { f(mesh.tets[t][e[0]], mesh.tets[t][e[1]]); });
  });
}

SizeField own_sizes(TetMesh mesh) {
  mesh.sizes = mean_edge_lengths(mesh);
  return [map = std::make_shared<MeshSizeField>(mesh)](const Vec3& p) { return (*map)(p); };
}

std::vector<float> required_sizes(const TetMesh& mesh, bool whole_surface) {
  if (!whole_surface && !has_required_edges(mesh)) return {};
  std::vector<float> sizes = mean_lengths(
      mesh, [&](TetId t, auto&& f) { for_each_required_edge(mesh, t, whole_surface, f); });
  if (std::all_of(sizes.begin(), sizes.end(), [](float h) { return h == 0; })) sizes.clear();
  return sizes;
}

}  // namespace cavea
