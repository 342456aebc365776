// The sizes that a SurfaceModel wants: for the sake of curvature, thin walls and narrow features.
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "cavea/base/parallel.h"
#include "cavea/geometry/closest.h"
#include "cavea/surface/surface_model.h"

namespace cavea {
namespace {

/// Wanted size where a wall is only so thick, over that thickness: an edge across is then 0.7 sizes
/// long and one along at most 1.4, so that one layer of good tets fits.
constexpr double kThickness = 1.4;
/// The same for strips between two feature curves and for short curves, where no edge but one that
/// follows them fits. Smaller would be better (0.7 raises the mean quality of a gear's teeth from
/// 0.76 to 0.78), but triples their tets, and the rim of a thin plate wants no more than the plate.
constexpr double kWidth = 1.0;
/// Cosine of 15 degrees: sheets and curves side by side within that angle bound a layer or a strip.
/// Where they run together in a sharper wedge, finer tets would be no better.
constexpr double kParallel = 0.966;

/// Patches that the bound on the bulge has flattened meet in creases. An edge of length h across
/// one of angle a sags by h a / 4 in the middle: wanted is 0.75 of the tolerance.
constexpr double kCreaseSag = 3.5;
/// Flatter ones, in radians, are left to the curvature.
constexpr double kSlightCrease = 0.3;
/// How fast sizes rise from a crease: as with the default gradation, log 1.3.
constexpr double kRise = 0.26;

}  // namespace

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
  double steepest = 0, total = 0;
  for (std::int32_t q : seen) {
    const Vec3 d = points_[q] - p;
    const double l2 = norm2(d);
    if (!(l2 > 0)) continue;
    const double kappa = 2 * dot(n, d) / l2;
    const double x = dot(d, e1), y = dot(d, e2), r2 = x * x + y * y;
    if (!(r2 > 0)) continue;
    steepest = std::max(steepest, std::abs(kappa));
    const Eigen::Vector3d row(x * x / r2, 2 * x * y / r2, y * y / r2);
    const double weight = l2;  // what q is off by tells in kappa the more, the shorter d is
    normal_matrix += weight * row * row.transpose();
    right += weight * kappa * row;
    total += weight;
  }
  // Fewer than three independent directions leave the form undetermined: then the steepest edge.
  constexpr double kIndependent = 1e-3;
  const Eigen::LDLT<Eigen::Matrix3d> ldlt(normal_matrix);
  if (seen.size() < 3 || !(ldlt.vectorD().minCoeff() > kIndependent * total)) return steepest;
  const Eigen::Vector3d form = ldlt.solve(right);
  const double mean = (form[0] + form[2]) / 2;
  const double radius = std::hypot((form[0] - form[2]) / 2, form[1]);
  return std::min(std::abs(mean) + radius, 2 * steepest);
}

/// The largest principal curvature of the smooth fan at each facet's corners.
std::vector<std::array<double, 3>> SurfaceModel::curvatures() const {
  std::vector<std::array<double, 3>> kappas(facets_.size());
  parallel_ranges(points_.size(), 256, [&](std::size_t begin, std::size_t end) {
    std::vector<std::int32_t> seen;
    for (std::size_t v = begin; v < end; ++v) {
      const bool one_fan = vertex_curve_[v] == kNone;
      double kappa = 0;
      for (std::int32_t i = vertex_first_[v]; i < vertex_first_[v + 1]; ++i) {
        const std::int32_t f = vertex_facets_[i];
        const int corner = corner_of(f, std::int32_t(v));
        if (!one_fan || i == vertex_first_[v]) kappa = curvature_of_fan(f, corner, seen);
        kappas[f][corner] = kappa;
      }
    }
  });
  return kappas;
}

/// The curvature at a vertex off the feature curves, averaged with those around that are, too.
/// Cut surfaces and scans are rough at the scale of their facets, where a size that follows each
/// vertex would ask for several times the tets that the shape does.
double SurfaceModel::averaged(const std::vector<std::array<double, 3>>& kappas,
                              std::int32_t v) const {
  const std::int32_t first = vertex_facets_[vertex_first_[v]];
  // Twice, as two facets share each of those around.
  double sum = 2 * kappas[first][corner_of(first, v)], weight = 2;
  for (std::int32_t i = vertex_first_[v]; i < vertex_first_[v + 1]; ++i) {
    const std::int32_t f = vertex_facets_[i];
    for (int k = 0; k < 3; ++k) {
      const std::int32_t q = facets_[f][k];
      if (q != v && vertex_curve_[q] == kNone) sum += kappas[f][k], ++weight;
    }
  }
  return sum / weight;
}

/// h = sqrt(9 eps / (2 kappa)) (paper, section 4.2); zero curvature gives hmax. At the corners of
/// facets for the curvature of their own sheet, at the vertices for those of all sheets and curves
/// that meet there: a sheet that is flat may have large sizes next to a curve, as fast as the
/// gradation lets them rise.
void SurfaceModel::set_sizes() {
  auto size_of = [&](std::int32_t v, double kappa) {
    const double tolerance = vertex_tolerance(v);
    const double h = kappa > 0 ? std::sqrt(4.5 * tolerance / kappa) : settings_.hmax;
    return std::clamp(h, settings_.hmin, settings_.hmax);
  };
  sizes_.assign(points_.size(), settings_.hmax);
  corner_sizes_.assign(facets_.size(), {settings_.hmax, settings_.hmax, settings_.hmax});
  if (settings_.hmin == settings_.hmax) return;
  const std::vector<std::array<double, 3>> kappas = curvatures();
  parallel_for(points_.size(), [&](std::size_t v) {
    const bool inside = vertex_curve_[v] == kNone;
    const double of_all = inside ? averaged(kappas, std::int32_t(v)) : 0;
    for (std::int32_t i = vertex_first_[v]; i < vertex_first_[v + 1]; ++i) {
      const std::int32_t f = vertex_facets_[i];
      const int k = corner_of(f, std::int32_t(v));
      corner_sizes_[f][k] = size_of(std::int32_t(v), inside ? of_all : kappas[f][k]);
      sizes_[v] = std::min(sizes_[v], corner_sizes_[f][k]);
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
      sizes_[c.v[end]] = std::min(sizes_[c.v[end]], size_of(c.v[end], kappa));
    }
}

/// The normal of a facet's patch at the place t of the edge opposite corner k, from vertex a on.
Vec3 SurfaceModel::normal_on_edge(std::int32_t f, int k, std::int32_t a, double t) const {
  std::array<double, 3> weights{};
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const bool from_i = facets_[f][i] == a;
  weights[i] = from_i ? 1 - t : t;
  weights[j] = from_i ? t : 1 - t;
  return normalized(patches_[f].normal(weights[1], weights[2]));
}

/// Whether the bound on the bulge has pulled one of the patch's edges towards the facet.
bool SurfaceModel::is_flattened(std::int32_t f) const {
  constexpr double kAtBound = 0.999;  // but for rounding
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const Vec3 a = points_[facets_[f][i]], d = points_[facets_[f][j]] - a;
    const double bound = kAtBound * bulge_between(facets_[f][i], facets_[f][j]);
    if (distance(patches_[f].edge[k][0], a + d / 3) > bound ||
        distance(patches_[f].edge[k][1], a + 2.0 / 3 * d) > bound)
      return true;
  }
  return false;
}

/// The size wanted along the edge opposite corner k for the sake of the crease between the two
/// patches, one of which is flattened, unless it is a feature.
double SurfaceModel::crease_size(std::int32_t f, int k) const {
  const std::int32_t g = smooth_neighbors_[f][k];
  if (facet_curve_[f][k] != kNone) return kEndless;
  const auto& of_g = smooth_neighbors_[g];
  const int l = of_g[0] == f ? 0 : of_g[1] == f ? 1 : 2;
  const std::int32_t a = facets_[f][(k + 1) % 3];
  double cosine = 1;  // facets of interfaces need not be oriented alike
  for (const double t : {0.25, 0.5, 0.75})
    cosine =
        std::min(cosine, std::abs(dot(normal_on_edge(f, k, a, t), normal_on_edge(g, l, a, t))));
  const double angle = std::acos(cosine);
  if (angle < kSlightCrease) return kEndless;
  return kCreaseSag * std::min(size_tolerance(f), size_tolerance(g)) / angle;
}

void SurfaceModel::set_crease_sizes() {
  std::vector<char> flattened(facets_.size());
  parallel_for(flattened.size(),
               [&](std::size_t f) { flattened[f] = is_flattened(std::int32_t(f)); });
  crease_sizes_.resize(facets_.size());
  parallel_for(facets_.size(), [&](std::size_t f) {
    for (int k = 0; k < 3; ++k) {
      const std::int32_t g = smooth_neighbors_[f][k];
      const bool may_crease = g != kNone && (flattened[f] || flattened[g]);
      crease_sizes_[f][k] = float(may_crease ? crease_size(std::int32_t(f), k) : kEndless);
    }
  });
}

/// The size at a place of a facet, or less near a crease.
double SurfaceModel::size_near_creases(std::int32_t f, const Vec3& place, double size) const {
  for (int k = 0; k < 3; ++k) {
    const double h = crease_sizes_[f][k];
    if (h >= size) continue;
    const Vec3 a = points_[facets_[f][(k + 1) % 3]], b = points_[facets_[f][(k + 2) % 3]];
    size = std::min(size, h + kRise * std::sqrt(closest_on_segment(place, a, b).distance2));
  }
  return size;
}

/// Length of each feature curve from corner to corner, at all of its edges; closed curves have
/// none.
void SurfaceModel::set_chain_lengths() {
  for (std::size_t first = 0; first < curves_.size(); ++first)
    for (int end = 0; end < 2; ++end) {
      if (curves_[first].next[end] != kNone || curves_[first].chain_length < kEndless) continue;
      // From the end of the chain to its other end, then again to tell the length.
      std::vector<std::int32_t> chain{std::int32_t(first)};
      double length = 0;
      for (int out = 1 - end;;) {
        const CurveEdge& c = curves_[chain.back()];
        length += distance(points_[c.v[0]], points_[c.v[1]]);
        const std::int32_t next = c.next[out];
        if (next == kNone) break;
        out = curves_[next].v[0] == c.v[out] ? 1 : 0;
        chain.push_back(next);
      }
      for (std::int32_t e : chain) curves_[e].chain_length = length;
    }
}

Vec3 SurfaceModel::at(const Anchor& anchor) const {
  if (is_curve(anchor)) return curves_[curve_of(anchor.facet)].curve.at(anchor.u);
  return patches_[anchor.facet].at(anchor.u, anchor.v);
}

double SurfaceModel::curved_size(const Anchor& anchor) const {
  if (anchor.facet == kNone) return settings_.hmax;
  if (is_curve(anchor)) {
    const CurveEdge& c = curves_[curve_of(anchor.facet)];
    return (1 - anchor.u) * sizes_[c.v[0]] + anchor.u * sizes_[c.v[1]];
  }
  const auto& at_corner = corner_sizes_[anchor.facet];
  const std::int32_t corner = corner_vertex(anchor);
  const double h = corner != kNone ? sizes_[corner]
                                   : (1 - double(anchor.u) - anchor.v) * at_corner[0] +
                                         anchor.u * at_corner[1] + anchor.v * at_corner[2];
  return size_near_creases(anchor.facet, at(anchor), h);
}

double SurfaceModel::size(const Anchor& anchor) const {
  double h = curved_size(anchor);
  if (anchor.facet == kNone) return h;
  if (is_curve(anchor)) return size_on_curve(curve_of(anchor.facet), at(anchor), h);
  if (const std::int32_t corner = corner_vertex(anchor); corner != kNone)
    for_each_curve_at(corner, [&](std::int32_t e) { h = size_on_curve(e, points_[corner], h); });
  return thin_size(anchor.facet, at(anchor), h);
}

double SurfaceModel::size_on_curve(std::int32_t e, const Vec3& place, double size) const {
  const CurveEdge& c = curves_[e];
  size = narrow_size(e, place, std::min(size, kWidth * c.chain_length));
  for (int i = 0; i < c.facet_count; ++i)
    size = thin_size(curve_facets_[c.first_facet + i], place, size);
  return std::max(size, settings_.hmin);
}

/// The size at a place of a facet, or less where the volume behind it is thin.
double SurfaceModel::thin_size(std::int32_t facet, const Vec3& place, double size) const {
  constexpr double kCone = 0.7;  // within 45 degrees of the normal
  for (const double side : {-1.0, 1.0}) {
    if (size <= settings_.hmin) break;
    if (side > 0 && facet_exterior_[facet]) continue;
    // Volume has a thickness: a sheet that touches is that of another body.
    const Sheets::Facing facing{side, kCone, -kParallel, false};
    const double t = sheets_->opposite(std::size_t(facet), place, facing, size / kThickness);
    size = std::min(size, kThickness * t);
  }
  return std::max(size, settings_.hmin);
}

/// The size at a place of a feature curve, or less where another one runs beside it, along the same
/// patch.
double SurfaceModel::narrow_size(std::int32_t e, const Vec3& place, double size) const {
  constexpr double kAcross = 0.5;  // more across than 60 degrees off the curve
  if (size <= settings_.hmin) return settings_.hmin;
  auto chord = [&](const CurveEdge& c) { return points_[c.v[1]] - points_[c.v[0]]; };
  const auto& own = curves_[e].v;
  const Vec3 along = normalized(chord(curves_[e]));
  const double reach = size / kWidth;
  double width2 = reach * reach;
  curve_tree_->visit_near(place, width2, [&](std::size_t slot) {
    const std::int32_t other = curve_tree_->order()[slot];
    const CurveEdge& c = curves_[other];
    const Vec3 d = chord(c);
    if (std::abs(dot(d, along)) < kParallel * norm(d) || !share_patch(e, other)) return;
    const bool adjacent =
        c.v[0] == own[0] || c.v[0] == own[1] || c.v[1] == own[0] || c.v[1] == own[1];
    const ClosestOnSegment near = closest_on_segment(place, points_[c.v[0]], points_[c.v[1]]);
    if (adjacent || !(near.distance2 < width2)) return;
    const Vec3 to = points_[c.v[0]] + near.t * d - place;
    if (std::abs(dot(to, along)) <= kAcross * norm(to)) width2 = near.distance2;
  });
  return std::min(size, kWidth * std::sqrt(width2));
}

bool SurfaceModel::share_patch(std::int32_t a, std::int32_t b) const {
  const CurveEdge &x = curves_[a], &y = curves_[b];
  for (int i = 0; i < x.facet_count; ++i)
    for (int j = 0; j < y.facet_count; ++j)
      if (facet_patch_[curve_facets_[x.first_facet + i]] ==
          facet_patch_[curve_facets_[y.first_facet + j]])
        return true;
  return false;
}

}  // namespace cavea
