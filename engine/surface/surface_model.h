#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/surface/bezier.h"
#include "cavea/surface/sheets.h"

namespace cavea {

/// A place on the ideal surface.
struct SurfacePoint {
  Vec3 point;
  Anchor anchor;
  double distance2 = 0;  ///< from the guess, squared
};

/// The ideal surface: a read-only snapshot of the input's surface triangles with a cubic Bezier
/// patch on each (paper, section 3.2) and a cubic curve on each feature edge. Read-only after
/// construction, so any number of threads may ask it at once.
///
/// Anchors of vertices: on a facet (facet >= 0, u and v), or on a feature curve
/// (facet = curve_anchor(edge), u = the curve's parameter).
class SurfaceModel {
 public:
  struct Settings {
    double tolerance = 0;  ///< hausd
    double max_bulge = 0;  ///< a control point is kept within this distance of the flat facet
    double hmin = 0, hmax = 0;
    /// Other tolerances for triangles of certain references, their bulges in proportion; read by
    /// the constructor only.
    std::span<const std::pair<std::int32_t, double>> tolerance_of_reference = {};
  };

  /// Takes the snapshot of a classified mesh (classify_features) and sets the anchors of its
  /// surface vertices.
  SurfaceModel(TetMesh& mesh, const Settings& settings);

  /// The point of patch `patch` near `guess`, found by walking from the anchors in `hints`; walks
  /// stay within the patch. distance2 is infinite when no hint touches the patch. It is the nearest
  /// point but for second-order terms, or any that is within `enough` tolerances.
  SurfacePoint place(const Vec3& guess, int patch, std::span<const Anchor> hints,
                     double enough = 0) const;

  /// The point near `guess` on the feature curve that the anchors lie on, or that starts at one of
  /// them if all are corners. distance2 infinite when there is no curve.
  SurfacePoint place_on_curve(const Vec3& guess, std::span<const Anchor> hints) const;

  /// Unit normal of the model at an anchor, of the side of `patch`.
  Vec3 normal(const Anchor& anchor, int patch) const;

  /// Unit tangent of the feature curve at an anchor on one, of either direction.
  Vec3 tangent(const Anchor& anchor) const;

  /// How far the surface may be from the model at an anchor: hausd, or less where another sheet of
  /// the exterior boundary is so near that both could meet.
  double tolerance(const Anchor& anchor) const;
  /// How far control points may be from the facets and chords at most.
  double max_bulge() const { return settings_.max_bulge; }
  /// hausd at a facet, by its reference.
  double hausd(std::int32_t facet) const { return facet_hausd_[std::size_t(facet)]; }
  double hausd(const Anchor& anchor) const;

  /// Size wanted at an anchor for the sake of the curvature (paper, section 4.2) and of thin walls,
  /// in [hmin, hmax].
  double size(const Anchor& anchor) const;
  /// The same for the sake of the curvature alone.
  double curved_size(const Anchor& anchor) const;

  /// The place of an anchor, which has one.
  Vec3 at(const Anchor& anchor) const;

  std::size_t facets() const { return facets_.size(); }
  std::size_t curve_edges() const { return curves_.size(); }
  std::array<Vec3, 2> curve_ends(std::int32_t e) const {
    return {points_[curves_[e].v[0]], points_[curves_[e].v[1]]};
  }
  /// The facets that meet at a feature curve's edge.
  std::span<const std::int32_t> facets_at_curve(std::int32_t e) const {
    const CurveEdge& c = curves_[std::size_t(e)];
    return {curve_facets_.data() + c.first_facet, std::size_t(c.facet_count)};
  }
  /// The anchor of the corner nearest to a place, if one is within reach.
  std::optional<Anchor> corner_near(const Vec3& place, double reach) const;
  int patch_number(std::int32_t f) const { return facet_patch_[f]; }
  const BezierTriangle& patch_of_facet(std::int32_t f) const { return patches_[f]; }
  std::array<Vec3, 3> facet_corners(std::int32_t f) const {
    return {points_[facets_[f][0]], points_[facets_[f][1]], points_[facets_[f][2]]};
  }

  /// Squared distance of a place from the flat facets; none less than `bound2` is `bound2`.
  double facets_distance2(const Vec3& place, double bound2) const {
    return sheets_->distance2(place, bound2);
  }

  /// As if the settings had had this bound of the bulge, or theirs if that is lower; not while
  /// others read.
  void limit_bulge(double max_bulge);

  static std::int32_t curve_anchor(std::int32_t edge) { return -2 - edge; }
  static std::int32_t curve_of(std::int32_t anchored_facet) { return -2 - anchored_facet; }
  static bool is_curve(const Anchor& a) { return a.facet <= -2; }

 private:
  static constexpr double kEndless = std::numeric_limits<double>::infinity();
  struct CurveEdge {
    std::array<std::int32_t, 2> v{kNone, kNone};
    std::array<std::int32_t, 2> next{kNone,
                                     kNone};  ///< the curve's edge beyond each end; none at corners
    BezierCurve curve;
    std::int32_t first_facet = 0, facet_count = 0;  ///< in curve_facets_
    double chain_length = kEndless;                 ///< of the whole curve between two corners
  };
  struct WalkResult {
    std::int32_t facet = kNone;
    double u = 0, v = 0, distance2 = 0;
  };

  void shape();
  void take_facets(TetMesh& mesh);
  void link_facets();
  std::vector<std::array<Vec3, 3>> all_corners() const;
  std::vector<Box> curve_boxes() const;
  std::vector<Vec3> given_normals(const TetMesh& mesh) const;
  void set_normals(const std::vector<Vec3>& given);
  void set_normals_at(std::int32_t v, const Vec3& given);
  void set_tolerances();
  void narrow_at_slits(double share);
  double empty_angle(const CurveEdge& c, std::int32_t f, std::int32_t g) const;
  Vec3 apex_over(const CurveEdge& c, std::int32_t f) const;
  double height_over(const CurveEdge& c, std::int32_t f) const;
  void set_tangents();
  void set_control_points();
  void flatten_folds();
  bool is_folded(std::int32_t facet) const;
  void set_chain_lengths();
  void set_sizes();
  void set_anchors(TetMesh& mesh) const;
  double curvature_of_fan(std::int32_t facet, int corner, std::vector<std::int32_t>& seen) const;
  std::vector<std::array<double, 3>> curvatures() const;
  double averaged(const std::vector<std::array<double, 3>>& kappas, std::int32_t v) const;
  double hausd_of(std::int32_t reference) const;
  double least_at(const Anchor& anchor, const std::vector<double>& of_facet) const;
  double size_tolerance(std::int32_t facet) const {
    return facet_at_slit_[facet] ? facet_hausd_[facet] : facet_tolerance_[facet];
  }
  double vertex_tolerance(std::int32_t v) const;
  double bulge_between(std::int32_t v, std::int32_t w) const {
    return std::min(vertex_bulge_[v], vertex_bulge_[w]);
  }
  Vec3 normal_on_edge(std::int32_t facet, int k, std::int32_t a, double t) const;
  bool is_flattened(std::int32_t facet) const;
  double crease_size(std::int32_t facet, int k) const;
  void set_crease_sizes();
  double size_near_creases(std::int32_t facet, const Vec3& place, double size) const;
  double size_on_curve(std::int32_t edge, const Vec3& place, double size) const;
  double narrow_size(std::int32_t edge, const Vec3& place, double size) const;
  bool share_patch(std::int32_t a, std::int32_t b) const;
  double thin_size(std::int32_t facet, const Vec3& place, double size) const;
  static Vec3 clamp_to_chord(const Vec3& control, const Vec3& chord_point, double bulge);
  std::array<Vec3, 2> edge_controls(std::int32_t facet, int k) const;

  Vec3 normal_on_curve(std::int32_t facet, const Anchor& anchor) const;
  std::int32_t corner_vertex(const Anchor& a) const;
  /// Which corner of a facet one of its vertices is.
  int corner_of(std::int32_t f, std::int32_t v) const {
    return facets_[f][0] == v ? 0 : facets_[f][1] == v ? 1 : 2;
  }
  Anchor anchor_of(std::int32_t v) const;
  WalkResult on_facet(const Vec3& guess, std::int32_t f) const;
  WalkResult walk(const Vec3& guess, WalkResult best) const;
  WalkResult nearest_start(const Vec3& guess, int patch, std::span<const Anchor> hints) const;
  template <class F>
  void for_each_start(const Anchor& anchor, int patch, F&& f) const;
  template <class F>
  void for_fan(std::int32_t facet, int corner, bool across_references, F&& f) const;

  /// Calls f(edge) for the curve edges that start at a corner of the snapshot, some twice.
  template <class F>
  void for_each_curve_at(std::int32_t v, F&& f) const {
    for (std::int32_t i = vertex_first_[v]; i < vertex_first_[v + 1]; ++i)
      for (const std::int32_t e : facet_curve_[vertex_facets_[i]])
        if (e != kNone && (curves_[e].v[0] == v || curves_[e].v[1] == v)) f(e);
  }

  /// Calls f(facet, facet) for each two facets at a curve edge.
  template <class F>
  void for_each_pair_of_facets(const CurveEdge& c, F&& f) const {
    for (std::int32_t i = 0; i < c.facet_count; ++i)
      for (std::int32_t j = 0; j < i; ++j)
        f(curve_facets_[c.first_facet + i], curve_facets_[c.first_facet + j]);
  }

  /// Steps of one walk; a walk that is longer has lost its way and ends where it is.
  static constexpr int kMaxWalk = 400;

  Settings settings_;
  std::vector<Vec3> points_;
  std::vector<std::array<std::int32_t, 3>> facets_;
  std::vector<int> facet_patch_;
  std::vector<char> facet_exterior_;
  std::vector<double> facet_hausd_, facet_tolerance_;
  std::vector<char> facet_at_slit_;  ///< beside next to no empty space (narrow_at_slits())
  /// Facet across the edge opposite corner k; none across ridges and non-manifold edges.
  std::vector<std::array<std::int32_t, 3>> smooth_neighbors_;
  std::vector<std::array<std::int32_t, 3>>
      facet_curve_;                           ///< feature edge opposite corner k, or none
  std::vector<std::array<Vec3, 3>> normals_;  ///< at the corners of each facet
  std::vector<BezierTriangle> patches_;
  std::vector<CurveEdge> curves_;
  std::vector<std::int32_t> curve_facets_;
  std::vector<std::int32_t> vertex_curve_;  ///< a curve edge at each vertex, or none
  std::vector<char> vertex_corner_;
  std::vector<std::int32_t> vertex_first_;  ///< CSR vertex -> facets
  std::vector<std::int32_t> vertex_facets_;
  std::vector<double>
      vertex_bulge_;  ///< largest distance of control points near it from the facets
  std::optional<Sheets> sheets_;
  std::optional<BoxTree> curve_tree_;
  std::vector<double> sizes_;  ///< at the vertices, for all sheets and curves there
  std::vector<std::array<double, 3>> corner_sizes_;  ///< of facets, for their own sheet
  std::vector<std::array<float, 3>>
      crease_sizes_;  ///< along the edge opposite corner k; infinite without a crease
  std::vector<std::int32_t> snapshot_vertex_;  ///< of the mesh's vertices, during construction only
};

/// Calls f(facet) for the facets around a corner that are reached from `facet` through smooth
/// edges.
template <class F>
void SurfaceModel::for_fan(std::int32_t facet, int corner, bool across_references, F&& f) const {
  const std::int32_t v = facets_[facet][corner];
  for (int direction = 1; direction <= 2; ++direction) {
    std::int32_t at = facet;
    int k = corner;
    for (int step = 0; step < kMaxWalk; ++step) {
      const int edge = (k + direction) % 3;
      if (!across_references && facet_curve_[at][edge] != kNone) break;
      at = smooth_neighbors_[at][edge];
      if (at == kNone) break;
      if (at == facet) return;  // once around
      f(at);
      k = corner_of(at, v);
    }
  }
}

}  // namespace cavea
