#include "cavea/remesh/junctions.h"

#include <algorithm>
#include <cmath>

#include "cavea/base/keep_once.h"
#include "cavea/geometry/closest.h"

namespace cavea {
namespace {

/// Of the way from one to the other of what is to meet: the middle moves neither far.
constexpr double kMeetings[] = {0.5, 0, 1};
/// Of the way from a tip to the middle of the side opposite: the farther, the larger the angle.
constexpr double kZips[] = {0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2};
/// The foot of a cap is at least this share of the edge away from its ends: else these may meet.
constexpr double kBesideEnds = 0.1;

bool is_on_surface(const TetMesh& mesh, VertexId v) { return mesh.vertex_tags[v] & tag::kSurface; }

/// The surface triangles on two or more vertices of tet t.
std::vector<TriangleId> triangles_at(OperatorContext& c, TetId t) {
  std::vector<TriangleId> found;
  const auto is_beside = [&](TriangleId id) {
    const auto& v = c.mesh.triangles[id].v;
    return std::ranges::count_if(v, [&](VertexId k) { return c.mesh.local_index(t, k) < 4; }) > 1;
  };
  for (const VertexId v : c.mesh.tets[t]) {
    if (!is_on_surface(c.mesh, v)) continue;
    gather_ball(c.mesh, v, c.marker, c.ball);
    for_each_triangle(c.mesh, c.ball, [&](TriangleId id) {
      if (is_beside(id)) found.push_back(id);
    });
  }
  keep_once(found);
  return found;
}

void add_tip(const TetMesh& mesh, TriangleId id, std::size_t k, std::vector<Junction>& found) {
  const Triangle& s = mesh.triangles[id];
  const std::size_t next = (k + 1) % 3, before = (k + 2) % 3;
  if (!(s.edge_tag[next] & s.edge_tag[before] & tag::kFeature)) return;
  const Vec3 tip = mesh.points[s.v[k]];
  const Vec3 middle = (mesh.points[s.v[next]] + mesh.points[s.v[before]]) / 2;
  for (const double share : kZips)
    found.push_back({{}, {{id, next}, {id, before}}, tip + share * (middle - tip)});
}

void add_cap(const TetMesh& mesh, TriangleId id, std::size_t k, std::vector<Junction>& found) {
  const Triangle& s = mesh.triangles[id];
  if (!(s.edge_tag[k] & tag::kFeature)) return;
  const Vec3 top = mesh.points[s.v[k]];
  const Vec3 a = mesh.points[s.v[(k + 1) % 3]], b = mesh.points[s.v[(k + 2) % 3]];
  const double along = dot(top - a, b - a) / norm2(b - a);
  if (!(along > kBesideEnds && along < 1 - kBesideEnds)) return;
  const Vec3 foot = a + along * (b - a);
  for (const double share : kMeetings)
    found.push_back({{s.v[k]}, {{id, k}}, top + share * (foot - top)});
}

}  // namespace

std::vector<Junction> junctions_of_vertices(const TetMesh& mesh, TetId t) {
  std::vector<Junction> found;
  for (const auto& e : kEdgeVertices) {
    const VertexId p = mesh.tets[t][e[0]], q = mesh.tets[t][e[1]];
    if (!is_on_surface(mesh, p) || !is_on_surface(mesh, q)) continue;
    for (const double share : kMeetings)
      found.push_back({{p, q}, {}, mesh.points[p] + share * (mesh.points[q] - mesh.points[p])});
  }
  return found;
}

std::vector<Junction> junctions_in_triangles(OperatorContext& c, TetId t) {
  std::vector<Junction> found;
  for (const TriangleId id : triangles_at(c, t))
    for (std::size_t k = 0; k < 3; ++k) {
      add_tip(c.mesh, id, k, found);
      add_cap(c.mesh, id, k, found);
    }
  return found;
}

std::vector<Moved> moved_by(const TetMesh& mesh, const Junction& junction) {
  std::vector<Moved> moved;
  for (const VertexId v : junction.vertices)
    moved.push_back({v, distance(mesh.points[v], junction.place)});
  for (const SurfaceSide& e : junction.edges) {
    const auto& v = mesh.triangles[e.triangle].v;
    const VertexId a = v[(e.k + 1) % 3], b = v[(e.k + 2) % 3];
    const double off2 =
        closest_on_segment(junction.place, mesh.points[a], mesh.points[b]).distance2;
    for (const VertexId end : {a, b}) moved.push_back({end, std::sqrt(off2)});
  }
  return moved;
}

}  // namespace cavea
