#include "cavea/mesh/compact.h"

#include "cavea/mesh/renumber.h"

namespace cavea {
namespace {

template <class T>
void keep(const Renumbering& ids, std::vector<T>& array) {
  array = ids.kept_of(array);
}

FaceLink renumbered(FaceLink link, const Renumbering& tets, const Renumbering& triangles) {
  if (link.is_tet()) return FaceLink::to_tet(tets[link.tet()], link.face());
  if (link.is_triangle()) return FaceLink::to_triangle(triangles[link.triangle()]);
  return link;
}

}  // namespace

void compact(TetMesh& mesh) {
  const Renumbering vertices = living_vertices(mesh), tets = living_tets(mesh),
                    triangles = living_triangles(mesh);
  if (vertices.count == mesh.points.size() && tets.count == mesh.tets.size() &&
      triangles.count == mesh.triangles.size())
    return;
  // One array at a time, so that no more than one is held twice.
  keep(vertices, mesh.points);
  keep(vertices, mesh.sizes);
  keep(vertices, mesh.vertex_tags);
  keep(vertices, mesh.vertex_refs);
  keep(vertices, mesh.vertex_tets);
  keep(vertices, mesh.anchors);
  keep(tets, mesh.tets);
  keep(tets, mesh.links);
  keep(tets, mesh.qualities);
  keep(tets, mesh.tet_refs);
  keep(tets, mesh.tet_flags);
  keep(triangles, mesh.triangles);
  for (GivenNormal& given : mesh.normals) given.vertex = vertices[given.vertex];
  std::erase_if(mesh.normals, [](const GivenNormal& given) { return given.vertex == kNone; });
  parallel_for(mesh.points.size(),
               [&](std::size_t v) { mesh.vertex_tets[v] = tets[mesh.vertex_tets[v]]; });
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    for (VertexId& v : mesh.tets[t]) v = vertices[v];
    for (FaceLink& link : mesh.links[t]) link = renumbered(link, tets, triangles);
  });
  parallel_for(mesh.triangles.size(), [&](std::size_t i) {
    Triangle& s = mesh.triangles[i];
    for (VertexId& v : s.v) v = vertices[v];
    for (FaceLink& side : s.sides) side = renumbered(side, tets, triangles);
  });
}

}  // namespace cavea
