#include "cavea/remesh/obstacle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cavea/geometry/dihedral.h"
#include "cavea/operator/edge_collapse.h"

namespace cavea {
namespace {

/// A tet with a smaller dihedral angle, in degrees, has at most a quality of 0.3.
constexpr double kSmallAngle = 13;
/// A tet on a triangle with a smaller angle has at most a quality of 0.35, and less where its
/// neighbours must share that angle.
constexpr double kSmallFaceAngle = 12;
/// The same, 0.4: a reason where there is no other.
constexpr double kRatherSmallFaceAngle = 14;
/// An edge between feature curves that is shorter than this, in wanted lengths, cannot be
/// collapsed, and its tets are needles.
constexpr double kNarrow = 0.3;
/// The same where it is shorter than this share of the longest edge of its tet: if all others are
/// alike, the quality is at most 0.3.
constexpr double kNeedle = 0.2;
/// A surface edge that is shorter than this, in wanted lengths, makes poor tets where it stays.
constexpr double kBend = 0.4;
/// Vertices on feature curves stay on them.
constexpr Tag kHeld = tag::kFeature | tag::kCorner;
/// If all edges at a vertex are within this angle of each other, in degrees, its tets have at most
/// a quality of 0.3: that of three edges of one length and 18.5 degrees apart.
constexpr double kSmallTip = 18.5;
/// Tets that an obstacle may have made poor, as is said of those in the report.
constexpr double kPoor = 0.3;
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

/// The smallest angle, in degrees, between feature curves that meet in a vertex of tet t and bound
/// a surface triangle with another one of its vertices.
double sharpest_tip(OperatorContext& c, TetId t) {
  double sharpest = 180;
  for (const VertexId v : c.mesh.tets[t]) {
    gather_ball(c.mesh, v, c.marker, c.ball);
    for_each_triangle(c.mesh, c.ball, [&](TriangleId id) {
      const Triangle& s = c.mesh.triangles[id];
      const std::size_t i = s.v[0] == v ? 0 : s.v[1] == v ? 1 : 2, j = (i + 1) % 3, k = (i + 2) % 3;
      if (!(s.edge_tag[j] & tag::kFeature) || !(s.edge_tag[k] & tag::kFeature)) return;
      if (c.mesh.local_index(t, s.v[j]) == 4 && c.mesh.local_index(t, s.v[k]) == 4) return;
      const Vec3 a = normalized(c.point(s.v[j]) - c.point(v)),
                 b = normalized(c.point(s.v[k]) - c.point(v));
      sharpest = std::min(sharpest, angle_between(a, b) * 180 / std::numbers::pi);
    });
  }
  return sharpest;
}

/// The largest angle, in degrees, between an edge of tet t and any other edge at a corner of it;
/// the least of those of all its corners.
double narrowest_point(OperatorContext& c, TetId t) {
  double narrowest = 180;
  for (const VertexId v : c.mesh.tets[t]) {
    if (!(c.tags(v) & tag::kCorner)) continue;
    gather_ball(c.mesh, v, c.marker, c.ball);
    double widest = 0;
    for (const TetId n : c.ball.tets)
      for (const VertexId a : c.mesh.tets[n])
        for (const VertexId b : c.mesh.tets[t]) {
          if (a == v || b == v) continue;
          const Vec3 x = c.point(a) - c.point(v), y = c.point(b) - c.point(v);
          widest = std::max(widest, angle_between(x, y));
        }
    narrowest = std::min(narrowest, widest * 180 / std::numbers::pi);
  }
  return narrowest;
}

/// The shortest edge of tet t that bridges feature curves, in wanted lengths; infinite if none
/// does.
struct Bridge {
  double length = 0, in_sizes = std::numeric_limits<double>::infinity();
  double of_longest = 1;  ///< edge of the tet
};

Bridge shortest_bridge(OperatorContext& c, TetId t) {
  Bridge shortest;
  double longest = 0;
  for (const auto& e : kEdgeVertices) {
    const VertexId a = c.mesh.tets[t][e[0]], b = c.mesh.tets[t][e[1]];
    const double length = distance(c.point(a), c.point(b));
    longest = std::max(longest, length);
    if (!(c.tags(a) & kHeld) || !(c.tags(b) & kHeld)) continue;
    const double in_sizes = c.length(a, b);
    if (in_sizes < shortest.in_sizes) shortest = {length, in_sizes};
  }
  if (longest > 0 && shortest.length > 0) shortest.of_longest = shortest.length / longest;
  return shortest;
}

/// Triangles between feature curves have no other vertices than theirs: the least height of those
/// at the vertices of tet t over an edge of a curve, also over the wanted length there.
struct Strip {
  double width = 0, in_sizes = std::numeric_limits<double>::infinity();

  void add(const OperatorContext& c, const Triangle& s) {
    double base = 0, size = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      size += c.mesh.sizes[s.v[k]] / 3;
      if (s.edge_tag[k] & tag::kFeature)
        base = std::max(base, distance(c.point(s.v[(k + 1) % 3]), c.point(s.v[(k + 2) % 3])));
    }
    const Vec3 p = c.point(s.v[0]);
    const double area2 = norm(cross(c.point(s.v[1]) - p, c.point(s.v[2]) - p));
    if (area2 < in_sizes * size * base) width = area2 / base, in_sizes = width / size;
  }
};

Strip narrowest_strip(OperatorContext& c, TetId t) {
  Strip narrowest;
  for (const VertexId v : c.mesh.tets[t]) {
    if (!(c.tags(v) & kHeld)) continue;
    gather_ball(c.mesh, v, c.marker, c.ball);
    for_each_triangle(c.mesh, c.ball, [&](TriangleId id) {
      const Triangle& s = c.mesh.triangles[id];
      if (std::ranges::all_of(s.v, [&](VertexId w) { return (c.tags(w) & kHeld) != 0; }))
        narrowest.add(c, s);
    });
  }
  return narrowest;
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
    found |= (s.is_exterior() ? along : std::abs(along)) > kThrough;
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

/// The shortest surface edge of tet t, in wanted lengths, whose ends must both stay, for the
/// surface bends too much between them or beside them.
Bridge shortest_bend(OperatorContext& c, TetId t) {
  Cavity cavity;
  const auto must_stay = [&](int i, int j) {
    gather_shell(c.mesh, t, i, j, c.shell);
    if (!c.shell.on_surface()) return false;
    const Verdict v = edge_collapse(c, true, cavity);
    return v == Verdict::kOffSurface || v == Verdict::kFolded;
  };
  Bridge shortest;
  for (const auto& e : kEdgeVertices) {
    const VertexId a = c.mesh.tets[t][e[0]], b = c.mesh.tets[t][e[1]];
    const double in_sizes = c.length(a, b);
    if (in_sizes < std::min(shortest.in_sizes, kBend) && must_stay(e[0], e[1]) &&
        must_stay(e[1], e[0]))
      shortest = {distance(c.point(a), c.point(b)), in_sizes};
  }
  return shortest;
}

/// How far the surface triangles at edges of tet t are from the ideal surface, in tolerances.
double largest_deviation(OperatorContext& c, TetId t) {
  c.fan.clear();
  for (const auto& e : kEdgeVertices) {
    gather_shell(c.mesh, t, e[0], e[1], c.shell);
    for (const Shell::At& at : c.shell.triangles)
      if (std::ranges::find(c.fan, at.triangle) == c.fan.end()) c.fan.push_back(at.triangle);
  }
  return c.limits.tolerance_share * std::sqrt(fit_of(c, c.fan).deviation2);
}

std::string obstacle_at(OperatorContext& c, TetId t) {
  if (const double angle = sharpest_wedge(c, t); angle < kSmallAngle)
    return fmt::format("the surface meets itself at {:.3g} degrees", angle);
  const double tip = sharpest_tip(c, t);
  const auto of_tip = [&] { return fmt::format("feature curves meet at {:.3g} degrees", tip); };
  if (tip < kSmallFaceAngle) return of_tip();
  if (const double angle = narrowest_point(c, t); angle < kSmallTip)
    return fmt::format("the domain ends in a tip of {:.3g} degrees", angle);
  if (const Bridge b = shortest_bridge(c, t); b.in_sizes < kNarrow || b.of_longest < kNeedle)
    return fmt::format("feature curves or corners are {:.3g} apart, {:.2g} of the wanted length",
                       b.length, b.in_sizes);
  if (const Strip s = narrowest_strip(c, t); s.in_sizes < kNarrow)
    return fmt::format(
        "the surface between feature curves is {:.3g} wide, {:.2g} of the wanted length", s.width,
        s.in_sizes);
  const Width width = width_of(c.mesh.corners(t));
  double size = 0;
  for (const VertexId v : c.mesh.tets[t]) size += c.mesh.sizes[v] / 4;
  if (width.thickness < c.limits.short_edge * size && is_between_walls(c, t, width))
    return fmt::format("the wall is {:.3g} thick, {:.2g} of the wanted length", width.thickness,
                       width.thickness / size);
  if (tip < kRatherSmallFaceAngle) return of_tip();
  if (const Bridge b = shortest_bend(c, t); b.length > 0)
    return fmt::format("the surface bends within {:.3g}, {:.2g} of the wanted length", b.length,
                       b.in_sizes);
  if (const double off = largest_deviation(c, t); off > 1)
    return fmt::format("the surface bends: triangles of the wanted size are {:.2g} tolerances off",
                       off);
  return "";
}

/// A tet and poor ones around it, each of which has a vertex in common with one before.
std::vector<TetId> poor_tets_around(OperatorContext& c, TetId t) {
  constexpr std::size_t kMost = 32;
  std::vector<TetId> found = {t};
  for (std::size_t i = 0; i < found.size() && found.size() < kMost; ++i)
    for (const VertexId v : c.mesh.tets[found[i]]) {
      gather_ball(c.mesh, v, c.marker, c.ball);
      for (const TetId n : c.ball.tets)
        if (c.mesh.qualities[n] < kPoor && std::ranges::find(found, n) == found.end())
          found.push_back(n);
    }
  return found;
}

}  // namespace

bool is_too_sharp(OperatorContext& c, TetId t) {
  return std::ranges::any_of(poor_tets_around(c, t), [&](TetId n) {
    return sharpest_wedge(c, n) < kSmallAngle || sharpest_tip(c, n) < kSmallFaceAngle ||
           narrowest_point(c, n) < kSmallTip;
  });
}

std::string obstacle_of(OperatorContext& c, TetId t) {
  std::string what = obstacle_at(c, t);
  for (int f = 0; f < 4 && what.empty(); ++f)
    if (const FaceLink link = c.mesh.links[t][f]; link.is_tet()) what = obstacle_at(c, link.tet());
  if (!what.empty()) return what;
  for (const TetId n : poor_tets_around(c, t))
    if (what = obstacle_at(c, n); !what.empty()) return "among the poor tets around: " + what;
  return "";
}

}  // namespace cavea
