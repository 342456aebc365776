#include "cavea/remesh/obstacle.h"

#include <fmt/format.h>

#include <algorithm>

#include "cavea/geometry/dihedral.h"

namespace cavea {
namespace {

/// A tet with a smaller dihedral angle, in degrees, has at most a quality of 0.3.
constexpr double kSmallAngle = 13;
/// Cosine between the way through a wall and the normals of its sides, 45 degrees.
constexpr double kThrough = 0.7;

/// The angle in degrees of the wedge of volume around tet t between the surface triangles at the
/// edge of a shell.
double wedge_around(const TetMesh& mesh, const Shell& s, TetId t) {
  const int tets = int(s.tets.size());
  const int here = int(std::ranges::find(s.tets, t) - s.tets.begin());
  const auto is_wall = [&](int ring) {  // ring[i] is between tets i - 1 and i
    return std::ranges::any_of(s.triangles, [&](const Shell::At& at) { return at.ring == ring; });
  };
  const auto angle = [&](int i) {
    return dihedral(mesh.points[s.p], mesh.points[s.q], mesh.points[s.ring_at(std::size_t(i))],
                    mesh.points[s.ring_at(std::size_t(i + 1))]);
  };
  double sum = angle(here);
  for (int step = 1; step < tets; ++step) {
    const int i = s.closed ? (here + step) % tets : here + step;
    if (i >= tets || is_wall(i)) break;
    sum += angle(i);
  }
  for (int step = 0; step < tets; ++step) {
    const int i = s.closed ? (here + tets - step) % tets : here - step;
    if (is_wall(i)) break;
    sum += angle(s.closed ? (i + tets - 1) % tets : i - 1);
  }
  return sum;
}

double sharpest_wedge(OperatorContext& c, TetId t) {
  double sharpest = 180;
  for (const auto& e : kEdgeVertices) {
    gather_shell(c.mesh, t, e[0], e[1], c.shell);
    if (c.shell.on_surface()) sharpest = std::min(sharpest, wedge_around(c.mesh, c.shell, t));
  }
  return sharpest;
}

/// The direction in which a tet is thinnest, and how thin it is.
struct Width {
  Vec3 direction;
  double thickness = std::numeric_limits<double>::infinity();

  void add(const Vec3& normal, const Vec3& between) {
    const Vec3 n = normalized(normal);
    if (norm2(n) > 0 && std::abs(dot(n, between)) < thickness)
      direction = n, thickness = std::abs(dot(n, between));
  }
};

Width width_of(const std::array<Vec3, 4>& p) {
  Width w;
  for (const auto& f : kFaceVertices)  // between a face and the vertex opposite
    w.add(cross(p[f[1]] - p[f[0]], p[f[2]] - p[f[0]]), p[6 - f[0] - f[1] - f[2]] - p[f[0]]);
  for (int e = 0; e < 3; ++e) {  // between opposite edges
    const auto& k = kEdgeVertices[e];
    w.add(cross(p[k[1]] - p[k[0]], p[k[3]] - p[k[2]]), p[k[2]] - p[k[0]]);
  }
  return w;
}

/// Whether some surface triangle at a vertex faces a direction.
bool faces(OperatorContext& c, VertexId v, const Vec3& direction) {
  bool found = false;
  gather_ball(c.mesh, v, c.marker, c.ball);
  for_each_triangle(c.mesh, c.ball, [&](TriangleId i) {
    const Triangle& s = c.mesh.triangles[i];
    const Vec3 a = c.point(s.v[0]);
    const double along =
        dot(normalized(cross(c.point(s.v[1]) - a, c.point(s.v[2]) - a)), direction);
    // An interface faces both ways.
    found |= (s.sides[1].is_tet() ? std::abs(along) : along) > kThrough;
  });
  return found;
}

/// Whether the vertices at both ends of the thinnest direction stand on walls that face that way.
bool is_between_walls(OperatorContext& c, TetId t, const Width& width) {
  const std::array<Vec3, 4> p = c.mesh.corners(t);
  const Vec3 center = (p[0] + p[1] + p[2] + p[3]) / 4;
  for (std::size_t k = 0; k < 4; ++k) {
    const double side = dot(p[k] - center, width.direction) > 0 ? 1 : -1;
    if (!faces(c, c.mesh.tets[t][k], side * width.direction)) return false;
  }
  return true;
}

}  // namespace

std::string obstacle_of(OperatorContext& c, TetId t) {
  if (const double angle = sharpest_wedge(c, t); angle < kSmallAngle)
    return fmt::format("the surface meets itself at {:.3g} degrees", angle);
  const Width width = width_of(c.mesh.corners(t));
  double size = 0;
  for (const VertexId v : c.mesh.tets[t]) size += c.mesh.sizes[v] / 4;
  if (width.thickness < c.limits.short_edge * size && is_between_walls(c, t, width))
    return fmt::format("the wall is {:.3g} thick, {:.2g} of the wanted length", width.thickness,
                       width.thickness / size);
  return "";
}

}  // namespace cavea
