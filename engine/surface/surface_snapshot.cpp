// Construction of the SurfaceModel: facets, normals, tangents, control points, anchors.
#include <algorithm>
#include <cmath>
#include <utility>

#include "cavea/base/parallel.h"
#include "cavea/surface/edges.h"
#include "cavea/surface/surface_model.h"
#include "cavea/surface/surface_vertices.h"

namespace cavea {
namespace {

/// A facet's two edges at one of its corners.
struct FacetAngle {
  Vec3 to_next, to_last;

  double mean_length2() const { return (norm2(to_next) + norm2(to_last)) / 2; }

  /// What the facet adds to the normal at the corner: its area over the squared lengths of the two
  /// edges (Max 1999, "Weights for computing vertex normals from facet normals"), with which the
  /// normals of any triangulation of a sphere are exact. By area alone (paper, section 3.1) large
  /// facets draw the normal towards theirs. Short edges count as longer: what tiny facets have for
  /// a normal is mostly noise.
  Vec3 share_of_normal(double short_length2) const {
    return cross(to_next, to_last) /
           ((norm2(to_next) + short_length2) * (norm2(to_last) + short_length2));
  }
};

/// A patch with control points within this share of the least height of its facet does not fold.
constexpr double kFlatShare = 0.25;

double least_height(const std::array<Vec3, 3>& p) {
  const double longest2 =
      std::max({distance2(p[0], p[1]), distance2(p[1], p[2]), distance2(p[2], p[0])});
  return longest2 > 0 ? norm(cross(p[1] - p[0], p[2] - p[0])) / std::sqrt(longest2) : 0;
}

FacetAngle angle_at(const std::array<Vec3, 3>& corners, int k) {
  return {corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]};
}

}  // namespace

SurfaceModel::SurfaceModel(TetMesh& mesh, const Settings& settings) : settings_(settings) {
  take_facets(mesh);
  link_facets();
  set_normals(given_normals(mesh));
  sheets_.emplace(all_corners(), facets_, facet_exterior_);
  set_tolerances();
  curve_tree_.emplace(curve_boxes());
  set_chain_lengths();
  shape();
  set_anchors(mesh);
  snapshot_vertex_ = {};
}

/// All that follows from how far patches may bulge.
void SurfaceModel::shape() {
  set_tangents();
  set_control_points();
  flatten_folds();
  set_sizes();
  set_crease_sizes();
}

void SurfaceModel::limit_bulge(double max_bulge) {
  settings_.max_bulge = std::min(settings_.max_bulge, max_bulge);
  const double bulge = settings_.max_bulge / settings_.tolerance;
  for (std::size_t f = 0; f < facets_.size(); ++f)
    for (std::int32_t v : facets_[f])
      vertex_bulge_[v] = std::min(vertex_bulge_[v], bulge * facet_hausd_[f]);
  shape();
}

void SurfaceModel::take_facets(TetMesh& mesh) {
  SurfaceVertices surface(mesh);
  for (const VertexId v : surface.vertices) {
    points_.push_back(mesh.points[v]);
    vertex_corner_.push_back((mesh.vertex_tags[v] & tag::kCorner) != 0);
  }
  snapshot_vertex_ = std::move(surface.number);
  std::vector<std::int32_t> facet_of(mesh.triangles.size(), kNone);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    if (!t.alive()) continue;
    facet_of[i] = std::int32_t(facets_.size());
    const auto at = [&](int k) { return snapshot_vertex_[t.v[k]]; };
    facets_.push_back({at(0), at(1), at(2)});
    facet_patch_.push_back(t.patch);
    facet_exterior_.push_back(t.is_exterior());
    facet_hausd_.push_back(hausd_of(t.ref));
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

std::vector<std::array<Vec3, 3>> SurfaceModel::all_corners() const {
  std::vector<std::array<Vec3, 3>> corners(facets_.size());
  parallel_for(corners.size(), [&](std::size_t f) { corners[f] = facet_corners(std::int32_t(f)); });
  return corners;
}

std::vector<Box> SurfaceModel::curve_boxes() const {
  std::vector<Box> boxes(curves_.size());
  for (std::size_t e = 0; e < curves_.size(); ++e)
    for (std::int32_t v : curves_[e].v) boxes[e].add(points_[v]);
  return boxes;
}

/// The unit normals that the mesh gives, by vertex; zero where it gives none.
std::vector<Vec3> SurfaceModel::given_normals(const TetMesh& mesh) const {
  std::vector<Vec3> given(points_.size());
  for (const GivenNormal& g : mesh.normals)
    if (const std::int32_t v = snapshot_vertex_[g.vertex]; v != kNone)
      given[v] = normalized(g.normal);
  return given;
}

/// The normal of the smooth fan around each corner of each facet; ridges end a fan, references do
/// not. Where the fan is all there is at the vertex, a given normal is right, but for its
/// direction: of an interface no side is the outer one.
void SurfaceModel::set_normals(const std::vector<Vec3>& given) {
  normals_.assign(facets_.size(), {});
  parallel_for(points_.size(), [&](std::size_t v) { set_normals_at(std::int32_t(v), given[v]); });
}

/// Each fan once, for all of its facets.
void SurfaceModel::set_normals_at(std::int32_t v, const Vec3& given) {
  constexpr double kShort = 0.05;  // of the fan's mean squared length
  auto corner = [&](std::int32_t f) { return corner_of(f, v); };
  const std::int32_t facets = vertex_first_[v + 1] - vertex_first_[v];
  std::vector<std::int32_t> fan;
  std::vector<FacetAngle> angles;
  for (std::int32_t i = 0; i < facets; ++i) {
    const std::int32_t first = vertex_facets_[vertex_first_[v] + i];
    if (norm2(normals_[first][corner(first)]) > 0) continue;  // of a fan before
    fan.assign(1, first);
    for_fan(first, corner(first), true, [&](std::int32_t f) { fan.push_back(f); });
    angles.clear();
    for (const std::int32_t f : fan) angles.push_back(angle_at(facet_corners(f), corner(f)));
    double length2 = 0;
    for (const FacetAngle& angle : angles) length2 += angle.mean_length2();
    Vec3 sum;
    for (const FacetAngle& angle : angles)
      sum += angle.share_of_normal(kShort * length2 / double(fan.size()));
    const double along = std::int32_t(fan.size()) == facets ? dot(given, sum) : 0;
    const Vec3 normal = along > 0 ? given : along < 0 ? -given : normalized(sum);
    for (std::size_t k = 0; k < fan.size(); ++k) {
      const std::int32_t f = fan[k];
      const Vec3 own = cross(angles[k].to_next, angles[k].to_last);
      // A fan that folds over itself has no normal to speak of; the facet's own keeps it flat here.
      normals_[f][corner(f)] = dot(normal, own) > 0 ? normal : normalized(own);
    }
  }
}

double SurfaceModel::hausd_of(std::int32_t reference) const {
  for (const auto& [of, tolerance] : settings_.tolerance_of_reference)
    if (of == reference) return tolerance;
  return settings_.tolerance;
}

/// The tolerance of each facet: that of its reference, but no more than a share of the way to the
/// next sheet of the exterior boundary across empty space, and the same for the bulge: so both
/// sheets may bulge and deviate and never meet. Inside the volume, tets keep sheets apart. Those
/// that touch stay as they are as far as may be, but no size would keep them from meeting.
void SurfaceModel::set_tolerances() {
  // Two sheets, each with its bulge and its deviation, and some for what lies between samples.
  constexpr double kShareOfGap = 0.2;
  // Sheets that touch have no gap; less than this share of hausd would count rounding.
  constexpr double kLeast = 1e-6;
  // What is ahead within 60 degrees and turned towards us by more than 107 degrees.
  constexpr Sheets::Facing kAcross{1, 0.5, -0.3};
  const double bulge = settings_.max_bulge / settings_.tolerance;
  const std::vector<double> gap = sheets_->all_opposite(kAcross, [&](std::size_t f) {
    return facet_exterior_[f] ? std::max(1.0, bulge) * facet_hausd_[f] / kShareOfGap : 0;
  });
  facet_tolerance_.resize(facets_.size());
  facet_at_slit_.assign(facets_.size(), 0);
  vertex_bulge_.assign(points_.size(), kEndless);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const double hausd = facet_hausd_[f], room = std::max(kShareOfGap * gap[f], kLeast * hausd);
    facet_at_slit_[f] = room == kLeast * hausd;
    facet_tolerance_[f] = std::min(hausd, room);
    for (std::int32_t v : facets_[f])
      vertex_bulge_[v] = std::min(vertex_bulge_[v], std::min(bulge * hausd, room));
  }
  narrow_at_slits(kShareOfGap);
}

/// Two facets of the exterior boundary with next to no empty space between them meet in an edge,
/// and so are no two sheets. They stay as flat as they are, each within a share of the way between
/// the ends of their heights; sizes need not follow from that.
void SurfaceModel::narrow_at_slits(double share) {
  // None that is wider was seen to close; and where round bodies touch, facets meet at a few
  // degrees.
  constexpr double kSlit = 2 * std::numbers::pi / 180;
  for (const CurveEdge& c : curves_)
    for_each_pair_of_facets(c, [&](std::int32_t f, std::int32_t g) {
      if (!facet_exterior_[f] || !facet_exterior_[g]) return;
      const double angle = empty_angle(c, f, g);
      if (angle >= kSlit) return;
      const double room = share * angle * std::min(height_over(c, f), height_over(c, g));
      for (const std::int32_t i : {f, g}) {
        facet_at_slit_[i] = 1;
        facet_tolerance_[i] = std::min(facet_tolerance_[i], room);
        for (const std::int32_t v : facets_[i]) vertex_bulge_[v] = std::min(vertex_bulge_[v], room);
      }
    });
}

/// The angle through empty space between two exterior facets at a curve, if they are turned
/// towards each other; else more than any.
double SurfaceModel::empty_angle(const CurveEdge& c, std::int32_t f, std::int32_t g) const {
  const auto normal = [&](std::int32_t i) {
    const auto [p, q, r] = facet_corners(i);
    return cross(q - p, r - p);
  };
  const Vec3 nf = normal(f), ng = normal(g), at = points_[c.v[0]];
  if (dot(nf, apex_over(c, g) - at) <= 0 || dot(ng, apex_over(c, f) - at) <= 0) return kEndless;
  return std::numbers::pi - angle_between(nf, ng);
}

/// The vertex of a facet that is not on its curve edge.
Vec3 SurfaceModel::apex_over(const CurveEdge& c, std::int32_t f) const {
  for (const std::int32_t v : facets_[f])
    if (v != c.v[0] && v != c.v[1]) return points_[v];
  return points_[c.v[0]];
}

double SurfaceModel::height_over(const CurveEdge& c, std::int32_t f) const {
  const Vec3 edge = points_[c.v[1]] - points_[c.v[0]];
  return norm(cross(edge, apex_over(c, f) - points_[c.v[0]])) / norm(edge);
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
    const double bulge = bulge_between(c.v[0], c.v[1]);
    c.curve.points = {
        a, clamp_to_chord(a + third * tangent(std::int32_t(e), 0), a + (b - a) / 3, bulge),
        clamp_to_chord(b + third * tangent(std::int32_t(e), 1), b + (a - b) / 3, bulge), b};
  });
}

/// Pulls a control point towards its place on the flat edge so that the bulge stays within bounds.
Vec3 SurfaceModel::clamp_to_chord(const Vec3& control, const Vec3& chord_point, double bulge) {
  const Vec3 d = control - chord_point;
  const double length = norm(d);
  return length <= bulge ? control : chord_point + (bulge / length) * d;
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
  const double bulge = bulge_between(facets_[f][i], facets_[f][j]);
  auto control = [&](const Vec3& from, const Vec3& to, const Vec3& n) {
    const Vec3 d = to - from;
    const Vec3 t = normalized(d - dot(d, n) * n);
    return clamp_to_chord(from + (norm(d) / 3) * t, from + d / 3, bulge);
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

/// A patch whose edges bulge by different amounts, beside a ridge for example, is steep where its
/// facet is flat: it may turn over, or stand on other patches.
void SurfaceModel::flatten_folds() {
  constexpr int kPasses = 4;  // what is flattened bends those around it
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<char> folded(facets_.size());
    parallel_for(folded.size(), [&](std::size_t f) { folded[f] = is_folded(std::int32_t(f)); });
    if (std::ranges::find(folded, 1) == folded.end()) return;
    for (std::size_t f = 0; f < folded.size(); ++f)
      if (folded[f])
        for (const std::int32_t v : facets_[f])
          vertex_bulge_[v] =
              std::min(vertex_bulge_[v], kFlatShare * least_height(facet_corners(std::int32_t(f))));
    set_tangents();
    set_control_points();
  }
}

/// Whether the normals of the patch are far from those of the surface at its corners.
bool SurfaceModel::is_folded(std::int32_t f) const {
  constexpr double kLeastCosine = 0.5;  // 60 degrees: operators allow surface triangles no more
  constexpr double kPlaces[][2] = {{1. / 3, 1. / 3}, {.5, 0},   {0, .5},   {.5, .5},
                                   {.7, .15},        {.15, .7}, {.15, .15}};
  const BezierTriangle& p = patches_[f];
  const double height = least_height(p.corner);
  double bulge2 = 0;
  for (int k = 0; k < 3; ++k) {
    const Vec3 a = p.corner[(k + 1) % 3], d = p.corner[(k + 2) % 3] - a;
    bulge2 = std::max(
        {bulge2, distance2(p.edge[k][0], a + d / 3), distance2(p.edge[k][1], a + 2.0 / 3 * d)});
  }
  if (height == 0 || bulge2 <= kFlatShare * kFlatShare * height * height) return false;
  return std::ranges::any_of(kPlaces, [&](const auto& at) {
    const auto& n = normals_[f];
    const Vec3 expected = (1 - at[0] - at[1]) * n[0] + at[0] * n[1] + at[1] * n[2];
    return dot(normalized(p.normal(at[0], at[1])), normalized(expected)) < kLeastCosine;
  });
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
    mesh.anchors[v] = anchor_of(s);
  }
}

}  // namespace cavea
