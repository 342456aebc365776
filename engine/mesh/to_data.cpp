#include <utility>

#include "cavea/mesh/build.h"
#include "cavea/mesh/renumber.h"
#include "cavea/mesh/surface_edges.h"

namespace cavea {
namespace {

/// The kept ones of a member of a mesh, which it loses if it is needed no more.
template <class T>
std::vector<T> kept(const Renumbering& ids, const std::vector<T>& all) {
  return ids.kept_of(all);
}
template <class T>
std::vector<T> kept(const Renumbering& ids, std::vector<T>&& all) {
  ids.keep_in(all);
  return std::move(all);
}

template <class Mesh>
void put_vertices(Mesh&& mesh, const Renumbering& vertices, MeshData& out) {
  bool all_known = true;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::int32_t id = vertices.new_id[v];
    if (id == kNone) continue;
    if (mesh.vertex_tags[v] & tag::kCorner) out.corners.push_back(id);
    if (mesh.vertex_tags[v] & tag::kRequired) out.required_vertices.push_back(id);
    all_known = all_known && mesh.sizes[v] > 0;
  }
  out.vertices = kept(vertices, std::forward<Mesh>(mesh).points);
  out.vertex_refs = kept(vertices, std::forward<Mesh>(mesh).vertex_refs);
  if (!all_known) return;
  const std::vector<float> sizes = kept(vertices, std::forward<Mesh>(mesh).sizes);
  out.sizes.assign(sizes.begin(), sizes.end());
}

template <class Mesh>
void put_tets(Mesh&& mesh, const Renumbering& vertices, MeshData& out) {
  const Renumbering tets = living_tets(mesh);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    if (tets.new_id[t] != kNone && (mesh.tet_flags[t] & tet_flag::kRequired))
      out.required_tets.push_back(tets.new_id[t]);
  out.tets = kept(tets, std::forward<Mesh>(mesh).tets);
  out.tet_refs = kept(tets, std::forward<Mesh>(mesh).tet_refs);
  parallel_for(out.tets.size(), [&](std::size_t t) {
    for (std::int32_t& v : out.tets[t]) v = vertices[v];
  });
}

void put_triangles(const TetMesh& mesh, const Renumbering& vertices, MeshData& out) {
  for (const Triangle& s : mesh.triangles) {
    if (!s.alive()) continue;
    if (s.tags & tag::kRequired)
      out.required_triangles.push_back(std::int32_t(out.triangles.size()));
    out.triangles.push_back({vertices[s.v[0]], vertices[s.v[1]], vertices[s.v[2]]});
    out.triangle_refs.push_back(s.ref);
  }
}

void put_edges(const TetMesh& mesh, const Renumbering& vertices, MeshData& out) {
  const SurfaceEdges edges(mesh);
  for (std::size_t a = 0; a < edges.vertices(); ++a)
    edges.for_each_at(mesh, VertexId(a), [&](VertexId b, SurfaceEdges::Uses uses) {
      const auto [triangle, k] = SurfaceEdges::decode(uses[0]);
      const Tag tags = mesh.triangles[triangle].edge_tag[k];
      if (!(tags & tag::kFeature)) return;
      const std::int32_t e = std::int32_t(out.edges.size());
      if (tags & tag::kRidge) out.ridges.push_back(e);
      if (tags & tag::kRequired) out.required_edges.push_back(e);
      out.edges.push_back({vertices[VertexId(a)], vertices[b]});
      out.edge_refs.push_back(mesh.triangles[triangle].edge_ref[k]);
    });
}

void put_normals(const TetMesh& mesh, const Renumbering& vertices, MeshData& out) {
  for (const GivenNormal& given : mesh.normals) {
    if (vertices[given.vertex] == kNone) continue;
    out.normal_at_vertices.push_back({vertices[given.vertex], std::int32_t(out.normals.size())});
    out.normals.push_back(given.normal);
  }
}

template <class Mesh>
MeshData lists_of(Mesh&& mesh) {
  MeshData out;
  const Renumbering vertices = living_vertices(mesh);
  put_triangles(mesh, vertices, out);
  put_edges(mesh, vertices, out);
  put_normals(mesh, vertices, out);
  // These may empty it.
  put_tets(std::forward<Mesh>(mesh), vertices, out);
  put_vertices(std::forward<Mesh>(mesh), vertices, out);
  return out;
}

}  // namespace

MeshData to_data(const TetMesh& mesh) { return lists_of(mesh); }
MeshData to_data(TetMesh&& mesh) { return lists_of(std::move(mesh)); }

}  // namespace cavea
