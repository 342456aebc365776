#include "cavea/mesh/compact.h"

#include <functional>

#include "cavea/mesh/renumber.h"

namespace cavea {
namespace {

FaceLink renumbered(FaceLink link, const Renumbering& tets, const Renumbering& triangles) {
  if (link.is_tet()) return FaceLink::to_tet(tets[link.tet()], link.face());
  if (link.is_triangle()) return FaceLink::to_triangle(triangles[link.triangle()]);
  return link;
}

}  // namespace

bool has_holes(const TetMesh& mesh) {
  const auto dead = [](std::size_t n, auto&& is_alive) {
    return parallel_reduce(
        n, false,
        [&](std::size_t begin, std::size_t end) {
          while (begin < end && is_alive(begin)) ++begin;
          return begin < end;
        },
        std::logical_or<>{});
  };
  return dead(mesh.points.size(), [&](std::size_t v) { return mesh.vertex_alive(VertexId(v)); }) ||
         dead(mesh.tets.size(), [&](std::size_t t) { return mesh.tet_alive(TetId(t)); }) ||
         dead(mesh.triangles.size(), [&](std::size_t i) { return mesh.triangles[i].alive(); });
}

void compact(TetMesh& mesh) {
  if (!has_holes(mesh)) return;
  const Renumbering vertices = living_vertices(mesh), tets = living_tets(mesh),
                    triangles = living_triangles(mesh);
  vertices.keep_in(mesh.points);
  vertices.keep_in(mesh.sizes);
  vertices.keep_in(mesh.vertex_tags);
  vertices.keep_in(mesh.vertex_refs);
  vertices.keep_in(mesh.vertex_tets);
  vertices.keep_in(mesh.anchors);
  tets.keep_in(mesh.tets);
  tets.keep_in(mesh.links);
  tets.keep_in(mesh.qualities);
  tets.keep_in(mesh.tet_refs);
  tets.keep_in(mesh.tet_flags);
  triangles.keep_in(mesh.triangles);
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
