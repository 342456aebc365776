#include "cavea/mesh/fill_holes.h"

#include <algorithm>

#include "cavea/base/ids_where.h"
#include "cavea/mesh/local.h"

namespace cavea {
namespace {

/// Calls move(from, to) for the last living ones, each into a hole; returns how many stay.
template <class Alive, class Move>
std::size_t close(std::size_t n, const std::vector<std::int32_t>& holes, Alive&& alive,
                  Move&& move) {
  const std::size_t kept = n - holes.size();
  std::size_t hole = 0;
  for (std::size_t from = kept; from < n; ++from)
    if (alive(std::int32_t(from))) move(std::int32_t(from), holes[hole++]);
  return kept;
}

class HoleFiller {
 public:
  HoleFiller(TetMesh& mesh, std::vector<std::int32_t>* of_tet) : mesh_(mesh), of_tet_(of_tet) {}

  void run() {
    const auto holes = ids_where(mesh_.tets.size(), [&](TetId t) { return !mesh_.tet_alive(t); });
    const std::size_t tets = close(
        mesh_.tets.size(), holes, [&](TetId t) { return mesh_.tet_alive(t); },
        [&](TetId from, TetId to) { move_tet(from, to); });
    mesh_.resize_tets(tets);
    if (of_tet_) of_tet_->resize(tets);
    fill_triangles();
    fill_vertices();
  }

 private:
  void move_tet(TetId from, TetId to) {
    mesh_.tets[to] = mesh_.tets[from];
    mesh_.links[to] = mesh_.links[from];
    mesh_.qualities[to] = mesh_.qualities[from];
    mesh_.tet_refs[to] = mesh_.tet_refs[from];
    mesh_.tet_flags[to] = mesh_.tet_flags[from];
    if (of_tet_) (*of_tet_)[to] = (*of_tet_)[from];
    for (int f = 0; f < 4; ++f) {
      const FaceLink link = mesh_.links[to][f];
      if (link.is_tet()) mesh_.links[link.tet()][link.face()] = FaceLink::to_tet(to, f);
      if (!link.is_triangle()) continue;
      for (FaceLink& side : mesh_.triangles[link.triangle()].sides)
        if (side == FaceLink::to_tet(from, f)) side = FaceLink::to_tet(to, f);
    }
    for (const VertexId v : mesh_.tets[to])
      if (mesh_.vertex_tets[v] == from) mesh_.vertex_tets[v] = to;
  }

  void fill_triangles() {
    auto& triangles = mesh_.triangles;
    const auto alive = [&](TriangleId s) { return triangles[s].alive(); };
    const auto holes = ids_where(triangles.size(), [&](TriangleId s) { return !alive(s); });
    triangles.resize(close(triangles.size(), holes, alive, [&](TriangleId from, TriangleId to) {
      triangles[to] = triangles[from];
      for (const FaceLink side : triangles[to].sides)
        if (side.is_tet()) mesh_.links[side.tet()][side.face()] = FaceLink::to_triangle(to);
    }));
  }

  void fill_vertices() {
    const auto alive = [&](VertexId v) { return mesh_.vertex_alive(v); };
    const auto holes = ids_where(mesh_.points.size(), [&](VertexId v) { return !alive(v); });
    mesh_.resize_vertices(close(mesh_.points.size(), holes, alive,
                                [&](VertexId from, VertexId to) { move_vertex(from, to); }));
  }

  void rename_in(TetId t, VertexId from, VertexId to) {
    std::ranges::replace(mesh_.tets[t], from, to);
    for (const FaceLink link : mesh_.links[t])
      if (link.is_triangle()) std::ranges::replace(mesh_.triangles[link.triangle()].v, from, to);
  }

  /// Not all tets at a pinched vertex are in its ball.
  void move_vertex(VertexId from, VertexId to) {
    if (mesh_.vertex_tags[from] & tag::kPinched) {
      for (std::size_t t = 0; t < mesh_.tets.size(); ++t) rename_in(TetId(t), from, to);
    } else {
      small_ball(mesh_, from, ball_);
      for (const TetId t : ball_) rename_in(t, from, to);
    }
    mesh_.points[to] = mesh_.points[from];
    mesh_.sizes[to] = mesh_.sizes[from];
    mesh_.vertex_tags[to] = mesh_.vertex_tags[from];
    mesh_.vertex_refs[to] = mesh_.vertex_refs[from];
    mesh_.vertex_tets[to] = mesh_.vertex_tets[from];
    mesh_.anchors[to] = mesh_.anchors[from];
    for (GivenNormal& given : mesh_.normals)
      if (given.vertex == from) given.vertex = to;
  }

  TetMesh& mesh_;
  std::vector<std::int32_t>* of_tet_;
  std::vector<TetId> ball_;
};

}  // namespace

void fill_holes(TetMesh& mesh, std::vector<std::int32_t>* of_tet) {
  HoleFiller(mesh, of_tet).run();
}

}  // namespace cavea
