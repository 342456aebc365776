#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/surface/bezier.h"

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
  };

  /// Takes the snapshot of a classified mesh (classify_features) and sets the anchors of its
  /// surface vertices.
  SurfaceModel(TetMesh& mesh, const Settings& settings);

  /// The point of patch `patch` near `guess`, found by walking from the anchors in `hints`; walks
  /// stay within the patch. distance2 is infinite when no hint touches the patch.
  SurfacePoint place(const Vec3& guess, int patch, std::span<const Anchor> hints) const;

  /// The point near `guess` on the feature curve that the anchors lie on, or that starts at one of
  /// them if all are corners. distance2 infinite when there is no curve.
  SurfacePoint place_on_curve(const Vec3& guess, std::span<const Anchor> hints) const;

  /// Unit normal of the model at an anchor, of the side of `patch`.
  Vec3 normal(const Anchor& anchor, int patch) const;

  /// Largest squared distance of the sample points of a triangle (edge midpoints and centroid) from
  /// the model. `hints` as for place().
  double deviation2(const std::array<Vec3, 3>& triangle, int patch,
                    std::span<const Anchor> hints) const;

  /// Size wanted at an anchor for the sake of the curvature (paper, section 4.2), in [hmin, hmax].
  double size(const Anchor& anchor) const;

  std::size_t facets() const { return facets_.size(); }
  const BezierTriangle& patch_of_facet(std::int32_t f) const { return patches_[f]; }
  std::array<Vec3, 3> facet_corners(std::int32_t f) const {
    return {points_[facets_[f][0]], points_[facets_[f][1]], points_[facets_[f][2]]};
  }

  /// Reduces by a factor (never below hmin) the wanted sizes within `radius` of a place, on the
  /// facets reached from the anchor over facets that are as near; not while others read.
  void shrink_sizes(const Vec3& place, const Anchor& anchor, double radius, double factor);

  static std::int32_t curve_anchor(std::int32_t edge) { return -2 - edge; }
  static bool is_curve(const Anchor& a) { return a.facet <= -2; }

 private:
  struct CurveEdge {
    std::array<std::int32_t, 2> v{kNone, kNone};
    std::array<std::int32_t, 2> next{kNone,
                                     kNone};  ///< the curve's edge beyond each end; none at corners
    BezierCurve curve;
    std::int32_t first_facet = 0, facet_count = 0;  ///< in curve_facets_
  };
  struct WalkResult {
    std::int32_t facet = kNone;
    double u = 0, v = 0, distance2 = 0;
  };

  void take_facets(TetMesh& mesh);
  void link_facets();
  void set_normals();
  void set_tangents();
  void set_control_points();
  void set_sizes();
  void set_anchors(TetMesh& mesh) const;
  double curvature_of_fan(std::int32_t facet, int corner, std::vector<std::int32_t>& seen) const;
  Vec3 clamp_to_chord(const Vec3& control, const Vec3& chord_point) const;
  std::array<Vec3, 2> edge_controls(std::int32_t facet, int k) const;

  std::int32_t corner_vertex(const Anchor& a) const;
  WalkResult walk(const Vec3& guess, std::int32_t start) const;
  template <class F>
  void for_each_start(const Anchor& anchor, int patch, F&& f) const;
  template <class F>
  void for_fan(std::int32_t facet, int corner, bool across_references, F&& f) const;

  /// Steps of one walk; a walk that is longer has lost its way and ends where it is.
  static constexpr int kMaxWalk = 400;

  Settings settings_;
  std::vector<Vec3> points_;
  std::vector<std::array<std::int32_t, 3>> facets_;
  std::vector<int> facet_patch_;
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
  std::vector<double> sizes_;
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
      k = facets_[at][0] == v ? 0 : facets_[at][1] == v ? 1 : 2;
    }
  }
}

}  // namespace cavea
