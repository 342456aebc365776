// Construction of the SurfaceModel: facets, normals, tangents, control points, sizes, anchors.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "cavea/base/parallel.h"
#include "cavea/surface/edges.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

SurfaceModel::SurfaceModel(TetMesh& mesh, const Settings& settings) : settings_(settings) {
  take_facets(mesh);
  link_facets();
  set_normals();
  set_tangents();
  set_control_points();
  set_sizes();
  set_anchors(mesh);
  snapshot_vertex_ = {};
}

void SurfaceModel::take_facets(TetMesh& mesh) {
  snapshot_vertex_.assign(mesh.points.size(), kNone);
  std::vector<std::int32_t> facet_of(mesh.triangles.size(), kNone);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (!t.alive()) continue;
    facet_of[i] = std::int32_t(facets_.size());
    std::array<std::int32_t, 3> f{};
    for (int k = 0; k < 3; ++k) {
      std::int32_t& id = snapshot_vertex_[t.v[k]];
      if (id == kNone) {
        id = std::int32_t(points_.size());
        points_.push_back(mesh.points[t.v[k]]);
        vertex_corner_.push_back((mesh.vertex_tags[t.v[k]] & tag::kCorner) != 0);
      }
      f[k] = id;
    }
    facets_.push_back(f);
    facet_patch_.push_back(t.patch);
  }
  smooth_neighbors_.assign(facets_.size(), {kNone, kNone, kNone});
  facet_curve_.assign(facets_.size(), {kNone, kNone, kNone});
  vertex_curve_.assign(points_.size(), kNone);

  for_each_edge(sorted_edge_sides(mesh.triangles), [&](const EdgeSide* begin, const EdgeSide* end) {
    const Tag tags = mesh.triangles[begin->triangle].edge_tag[begin->k];
    const bool smooth = end - begin == 2 && !(tags & (tag::kRidge | tag::kNonManifold));
    if (smooth) {
      smooth_neighbors_[facet_of[begin[0].triangle]][begin[0].k] = facet_of[begin[1].triangle];
      smooth_neighbors_[facet_of[begin[1].triangle]][begin[1].k] = facet_of[begin[0].triangle];
    }
    if (!(tags & tag::kFeature)) return;
    const std::int32_t id = std::int32_t(curves_.size());
    CurveEdge c;
    c.v = {snapshot_vertex_[begin->a], snapshot_vertex_[begin->b]};
    c.first_facet = std::int32_t(curve_facets_.size());
    c.facet_count = std::int32_t(end - begin);
    for (const EdgeSide* s = begin; s != end; ++s) {
      curve_facets_.push_back(facet_of[s->triangle]);
      facet_curve_[facet_of[s->triangle]][s->k] = id;
    }
    for (std::int32_t v : c.v) vertex_curve_[v] = id;
    curves_.push_back(c);
  });
}

void SurfaceModel::link_facets() {
  vertex_first_.assign(points_.size() + 1, 0);
  for (const auto& f : facets_)
    for (std::int32_t v : f) ++vertex_first_[v + 1];
  for (std::size_t v = 0; v < points_.size(); ++v) vertex_first_[v + 1] += vertex_first_[v];
  vertex_facets_.resize(3 * facets_.size());
  std::vector<std::int32_t> at(vertex_first_.begin(), vertex_first_.end() - 1);
  for (std::size_t f = 0; f < facets_.size(); ++f)
    for (std::int32_t v : facets_[f]) vertex_facets_[at[v]++] = std::int32_t(f);

  // Curves continue through vertices that are no corners; such a vertex is on exactly two edges.
  std::vector<std::array<std::int32_t, 2>> at_vertex(points_.size(), {kNone, kNone});
  for (std::size_t e = 0; e < curves_.size(); ++e)
    for (std::int32_t v : curves_[e].v)
      (at_vertex[v][0] == kNone ? at_vertex[v][0] : at_vertex[v][1]) = std::int32_t(e);
  for (std::size_t e = 0; e < curves_.size(); ++e)
    for (int end = 0; end < 2; ++end) {
      const std::int32_t v = curves_[e].v[end];
      if (vertex_corner_[v]) continue;
      curves_[e].next[end] = at_vertex[v][0] == std::int32_t(e) ? at_vertex[v][1] : at_vertex[v][0];
    }
}

/// Area-weighted normal of the smooth fan around each corner of each facet (paper, section 3.1);
/// ridges end a fan, references do not.
void SurfaceModel::set_normals() {
  std::vector<Vec3> area(facets_.size());
  parallel_for(facets_.size(), [&](std::size_t f) {
    const auto [a, b, c] = facet_corners(std::int32_t(f));
    area[f] = cross(b - a, c - a);
  });
  normals_.resize(facets_.size());
  parallel_for(facets_.size(), [&](std::size_t f) {
    for (int k = 0; k < 3; ++k) {
      Vec3 sum = area[f];
      for_fan(std::int32_t(f), k, true, [&](std::int32_t g) { sum += area[g]; });
      normals_[f][k] = normalized(sum);
      // A fan that folds over itself has no normal to speak of; the facet's own keeps it flat here.
      if (dot(normals_[f][k], area[f]) <= 0) normals_[f][k] = normalized(area[f]);
    }
  });
}

/// Curves: at a vertex where the curve goes on, the tangent of the circle through the neighbours;
/// at a corner, the chord. The control points are a third of the chord's length along the tangents.
void SurfaceModel::set_tangents() {
  auto tangent = [&](std::int32_t e, int end) {
    const CurveEdge& c = curves_[e];
    const Vec3 here = points_[c.v[end]], there = points_[c.v[1 - end]];
    const double length = distance(here, there);
    const Vec3 chord = normalized(there - here);
    if (c.next[end] == kNone) return chord;
    const CurveEdge& n = curves_[c.next[end]];
    const Vec3 before = points_[n.v[0] == c.v[end] ? n.v[1] : n.v[0]];
    const Vec3 t = length * normalized(here - before) + distance(here, before) * chord;
    return norm2(t) > 0 ? normalized(t) : chord;
  };
  parallel_for(curves_.size(), [&](std::size_t e) {
    CurveEdge& c = curves_[e];
    const Vec3 a = points_[c.v[0]], b = points_[c.v[1]];
    const double third = distance(a, b) / 3;
    c.curve.points = {a, clamp_to_chord(a + third * tangent(std::int32_t(e), 0), a + (b - a) / 3),
                      clamp_to_chord(b + third * tangent(std::int32_t(e), 1), b + (a - b) / 3), b};
  });
}

/// Pulls a control point towards its place on the flat edge so that the bulge stays within bounds.
Vec3 SurfaceModel::clamp_to_chord(const Vec3& control, const Vec3& chord_point) const {
  const Vec3 d = control - chord_point;
  const double length = norm(d);
  return length <= settings_.max_bulge ? control : chord_point + (settings_.max_bulge / length) * d;
}

/// The two control points of the edge opposite corner k of a facet, from corner k+1 to k+2: those
/// of the curve on feature edges, else on the tangent planes at the ends (paper, section 3.2.2,
/// with |b1 - b0| a third of the edge).
std::array<Vec3, 2> SurfaceModel::edge_controls(std::int32_t f, int k) const {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  if (const std::int32_t e = facet_curve_[f][k]; e != kNone) {
    const CurveEdge& c = curves_[e];
    if (c.v[0] == facets_[f][i]) return {c.curve.points[1], c.curve.points[2]};
    return {c.curve.points[2], c.curve.points[1]};
  }
  const Vec3 a = points_[facets_[f][i]], b = points_[facets_[f][j]];
  auto control = [&](const Vec3& from, const Vec3& to, const Vec3& n) {
    const Vec3 d = to - from;
    const Vec3 t = normalized(d - dot(d, n) * n);
    return clamp_to_chord(from + (norm(d) / 3) * t, from + d / 3);
  };
  return {control(a, b, normals_[f][i]), control(b, a, normals_[f][j])};
}

void SurfaceModel::set_control_points() {
  patches_.resize(facets_.size());
  parallel_for(facets_.size(), [&](std::size_t f) {
    BezierTriangle& p = patches_[f];
    p.corner = facet_corners(std::int32_t(f));
    for (int k = 0; k < 3; ++k) p.edge[k] = edge_controls(std::int32_t(f), k);
    p.set_center();
  });
}

/// Largest principal curvature of the smooth fan at a corner: the second fundamental form that fits
/// the normal curvatures 2 n.(q - p) / |q - p|^2 of the fan's edges best.
double SurfaceModel::curvature_of_fan(std::int32_t facet, int corner,
                                      std::vector<std::int32_t>& seen) const {
  const std::int32_t v = facets_[facet][corner];
  const Vec3 p = points_[v], n = normals_[facet][corner];
  seen.clear();
  auto add = [&](std::int32_t f) {
    for (std::int32_t q : facets_[f])
      if (q != v && std::find(seen.begin(), seen.end(), q) == seen.end()) seen.push_back(q);
  };
  add(facet);
  for_fan(facet, corner, true, add);
  const Vec3 helper = std::abs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 e1 = normalized(cross(n, helper)), e2 = cross(n, e1);
  Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double steepest = 0;
  for (std::int32_t q : seen) {
    const Vec3 d = points_[q] - p;
    const double l2 = norm2(d);
    if (!(l2 > 0)) continue;
    const double kappa = 2 * dot(n, d) / l2;
    const double x = dot(d, e1), y = dot(d, e2), r2 = x * x + y * y;
    if (!(r2 > 0)) continue;
    steepest = std::max(steepest, std::abs(kappa));
    const Eigen::Vector3d row(x * x / r2, 2 * x * y / r2, y * y / r2);
    normal_matrix += row * row.transpose();
    right += kappa * row;
  }
  // Fewer than three independent directions leave the form undetermined: then the steepest edge.
  constexpr double kIndependent = 1e-3;
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(normal_matrix);
  if (seen.size() < 3 || !(ldlt.vectorD().minCoeff() > kIndependent)) return steepest;
  const Eigen::Vector3d form = ldlt.solve(right);
  const double mean = (form[0] + form[2]) / 2;
  const double radius = std::hypot((form[0] - form[2]) / 2, form[1]);
  return std::min(std::abs(mean) + radius, 2 * steepest);
}

/// h = sqrt(9 eps / (2 kappa)) at each vertex, smallest over its fans and its curve (paper, section
/// 4.2); zero curvature gives hmax.
void SurfaceModel::set_sizes() {
  auto size_of = [&](double kappa) {
    const double h = kappa > 0 ? std::sqrt(4.5 * settings_.tolerance / kappa) : settings_.hmax;
    return std::clamp(h, settings_.hmin, settings_.hmax);
  };
  sizes_.assign(points_.size(), settings_.hmax);
  parallel_ranges(points_.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> seen;
    for (std::size_t v = begin; v < end; ++v) {
      double kappa = 0;
      for (std::int32_t i = vertex_first_[v]; i < vertex_first_[v + 1]; ++i) {
        const std::int32_t f = vertex_facets_[i];
        const int corner = facets_[f][0] == std::int32_t(v)   ? 0
                           : facets_[f][1] == std::int32_t(v) ? 1
                                                              : 2;
        kappa = std::max(kappa, curvature_of_fan(f, corner, seen));
        if (vertex_curve_[v] == kNone) break;  // a single fan: all its facets give the same
      }
      sizes_[v] = size_of(kappa);
    }
  });
  for (const CurveEdge& c : curves_)
    for (int end = 0; end < 2; ++end) {
      if (c.next[end] == kNone) continue;
      const CurveEdge& n = curves_[c.next[end]];
      const Vec3 p = points_[c.v[end]], a = points_[c.v[1 - end]],
                 b = points_[n.v[0] == c.v[end] ? n.v[1] : n.v[0]];
      const double product = distance(p, a) * distance(p, b) * distance(a, b);
      const double kappa = product > 0 ? 2 * norm(cross(a - p, b - p)) / product : 0;
      sizes_[c.v[end]] = std::min(sizes_[c.v[end]], size_of(kappa));
    }
}

void SurfaceModel::set_anchors(TetMesh& mesh) const {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const std::int32_t s = snapshot_vertex_[v];
    mesh.anchors[v] = {};
    if (s == kNone) continue;
    if (!vertex_corner_[s] && vertex_curve_[s] != kNone) {
      const std::int32_t e = vertex_curve_[s];
      mesh.anchors[v] = {curve_anchor(e), curves_[e].v[0] == s ? 0.0f : 1.0f, 0};
      continue;
    }
    const std::int32_t f = vertex_facets_[vertex_first_[s]];
    mesh.anchors[v] = {f, facets_[f][1] == s ? 1.0f : 0.0f, facets_[f][2] == s ? 1.0f : 0.0f};
  }
}

}  // namespace cavea
