#include "cavea/implicit/vertex_moves.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cavea/geometry/predicates.h"

namespace cavea {
namespace {

/// Triangles whose normals' sine is below this are in one plane: boxes have it to rounding.
constexpr double kOnePlane = 1e-6;

Vec3 unit_normal(const TetMesh& mesh, const Triangle& s) {
  const Vec3 a = mesh.points[s.v[0]];
  return normalized(cross(mesh.points[s.v[1]] - a, mesh.points[s.v[2]] - a));
}

}  // namespace

void VertexMoves::gather(VertexId v) {
  if (ball_.v != v) gather_ball(mesh_, v, marker_, ball_);
}

Vec3 VertexMoves::along_boundary(VertexId v, const Vec3& step) {
  if (!(mesh_.vertex_tags[v] & tag::kSurface)) return step;
  gather(v);
  Vec3 normal, line;
  bool fixed = mesh_.vertex_tags[v] & tag::kRequired;
  for_each_triangle(mesh_, ball_, [&](TriangleId s) {
    if (!is_boundary(mesh_.triangles[s])) return;
    fixed |= (mesh_.vertex_tags[v] & tag::kCorner) != 0;
    const Vec3 n = unit_normal(mesh_, mesh_.triangles[s]);
    if (norm2(normal) == 0) normal = n;
    const Vec3 other = cross(normal, n);
    if (norm(other) < kOnePlane) return;
    if (norm2(line) == 0) line = normalized(other);
    fixed |= std::abs(dot(line, n)) > kOnePlane;
  });
  if (fixed) return {};
  return norm2(line) > 0 ? line * dot(line, step) : step - normal * dot(normal, step);
}

bool VertexMoves::is_boundary(const Triangle& s) const {
  return s.is_exterior() && std::ranges::find(free_refs_, s.ref) == free_refs_.end();
}

Vec3 VertexMoves::to_zero(VertexId v, std::span<const LevelSet* const> level_sets, double reach) {
  return way_to_zero(level_sets, mesh_.points[v], reach,
                     [&](const Vec3& direction) { return along_boundary(v, direction); });
}

bool VertexMoves::move(VertexId v, const Vec3& step, const MoveLimits& limits,
                       const Accepts& accepts) {
  gather(v);
  const Vec3 from = mesh_.points[v];
  for (const double part : {1.0, 0.5, 0.25}) {
    if (!allows(from + step * part, limits)) continue;
    mesh_.points[v] = from + step * part;
    if (accepts && !accepts(ball_.tets)) {
      mesh_.points[v] = from;
      continue;
    }
    for (std::size_t i = 0; i < ball_.tets.size(); ++i)
      mesh_.qualities[ball_.tets[i]] = qualities_[i];
    return true;
  }
  return false;
}

bool VertexMoves::allows(const Vec3& place, const MoveLimits& limits) {
  float worst = 1;
  for (const TetId t : ball_.tets) worst = std::min(worst, mesh_.qualities[t]);
  const double least = std::max(kFlat, std::min(limits.share * worst, limits.floor));
  qualities_.clear();
  for (const TetId t : ball_.tets) {
    auto corners = mesh_.corners(t);
    corners[mesh_.local_index(t, ball_.v)] = place;
    const auto& [a, b, c, d] = corners;
    qualities_.push_back(float(tet_quality(a, b, c, d)));
    // Above kFlat the quality proves the orientation, too.
    if (!(qualities_.back() > least)) return false;
  }
  return true;
}

double VertexMoves::shortest_edge(VertexId v) {
  gather(v);
  double shortest2 = std::numeric_limits<double>::infinity();
  for (const TetId t : ball_.tets)
    for (const VertexId w : mesh_.tets[t])
      if (w != v) shortest2 = std::min(shortest2, distance2(mesh_.points[v], mesh_.points[w]));
  return std::sqrt(shortest2);
}

}  // namespace cavea
