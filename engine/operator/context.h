#pragma once
#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "cavea/cavity/cavity.h"
#include "cavea/cavity/verdict.h"
#include "cavea/geometry/metric.h"
#include "cavea/geometry/star.h"
#include "cavea/mesh/local.h"
#include "cavea/operator/small_polyhedron.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// Collapses may make edges this many times too long, which the next sweep splits or relocation
/// shortens: without, two of three edges that stay too short are stuck.
inline constexpr double kToleratedLong = 1.05;

/// What raises the worst quality may make edges this many times too long: a later split mends them.
inline constexpr double kRelaxedLong = 1.4;

/// What a phase of the recipe allows its operators (paper, section 4.3: each phase is stricter than
/// the one before).
struct Limits {
  double long_edge = kLongEdge;    ///< edges above are split; no collapse makes one
  double short_edge = kShortEdge;  ///< edges below are collapsed
  /// No split makes an edge shorter than this, except its own halves.
  double shortest_made = 0;
  /// Nor does a split that a collapse could undo, since it would make no more than a tolerated edge
  /// of it, make one that is to be collapsed. Before the end, to and fro finds what is better.
  bool leave_tolerated = false;
  /// A split or collapse may lower the worst quality of its cavity to this fraction of what it
  /// was...
  double quality_ratio = 0.5;
  /// ... or to this value.
  double quality_floor = 0.3;
  /// Share of the surface model's tolerance that the samples of surface triangles may use up.
  double tolerance_share = 1;
  /// All of hausd may be used up beside slits, too: who asks looks for crossings.
  bool bridges_slits = false;
  /// Poor tets with two faces on a smooth surface may be taken off it.
  bool ears_go = false;
  bool surface_frozen = false;  ///< no surface triangle or vertex of one is touched
};

/// What the operators read, and their scratch space: one a thread of control, reused.
struct OperatorContext {
  OperatorContext(const TetMesh& m, const SurfaceModel& s) : mesh(m), surface(s) {}

  const TetMesh& mesh;
  const SurfaceModel& surface;
  Limits limits;

  TetMarker marker, vertex_marker;
  Ball ball, second_ball;
  /// The other vertices of the ball, and a tet that has each: for collapses.
  std::vector<std::pair<VertexId, TetId>> around;
  Shell shell;
  std::vector<TriangleId> fan;
  std::vector<float> qualities;
  SmallPolyhedron polyhedron;  ///< of the cavity that is reconnected
  Star star;                   ///< of the ball, while places for its vertex are tried

  Vec3 point(VertexId v) const { return mesh.points[v]; }
  Tag tags(VertexId v) const { return mesh.vertex_tags[v]; }
  double length(VertexId a, VertexId b) const {
    return metric_length(distance(mesh.points[a], mesh.points[b]), mesh.sizes[a], mesh.sizes[b]);
  }
  bool length_exceeds(VertexId a, VertexId b, double limit) const {
    return cavea::length_exceeds(distance2(mesh.points[a], mesh.points[b]), mesh.sizes[a],
                                 mesh.sizes[b], limit);
  }
  /// Squared distance from the ideal surface that is allowed at an anchor.
  double tolerance2(const Anchor& anchor) const {
    const double t = limits.tolerance_share *
                     (limits.bridges_slits ? surface.hausd(anchor) : surface.tolerance(anchor));
    return t * t;
  }
  /// Edge that belongs to the interface of the part, or to a required edge or tet.
  bool frozen_edge(VertexId a, VertexId b) const {
    const Tag both = Tag(tags(a) & tags(b));
    return both & (tag::kFrozen | tag::kOnRequiredEdge);
  }
  double quality(VertexId a, VertexId b, VertexId c, VertexId d) const {
    return tet_quality(point(a), point(b), point(c), point(d));
  }
  /// Lowest quality that a split or collapse may leave where the worst was `before`. From a bad
  /// start any progress is progress.
  double lowest_allowed(double before) const {
    return std::min(limits.quality_floor, limits.quality_ratio * before);
  }
};

/// Makes context.around that of context.ball.
void gather_around(OperatorContext& context);

/// Makes context.star the faces of context.ball opposite its vertex, ready for qualities.
void prepare_star(OperatorContext& context);

/// An operation for the sake of quality must raise the worst quality of its cavity by at least this
/// factor; smaller gains would let operations go to and fro.
inline constexpr double kQualityGain = 1.02;

/// How surface triangles fit the ideal surface: the worst of several.
struct SurfaceFit {
  double cosine = 1;  ///< between a triangle's normal and the ideal surface's below its centroid
  double deviation2 = 0;  ///< largest squared distance of the sample points, in tolerances there

  void add(const SurfaceFit& other) {
    cosine = std::min(cosine, other.cosine);
    deviation2 = std::max(deviation2, other.deviation2);
  }
};

/// Fit of one triangle of `patch`; `hints` are anchors near it. Sampled at the centroid and in the
/// middle of those `sides` (a bit each; side k goes from corner k to the next).
SurfaceFit fit_triangle(const OperatorContext& context, const std::array<Vec3, 3>& corners,
                        int patch, std::span<const Anchor> hints, unsigned sides = 7);

/// The sides at corner i of a triangle to sample where all triangles around that corner are: a side
/// within a patch once, one on a curve with each of its triangles, since these may be of different
/// patches; so are those of interfaces, whose triangles need not be oriented alike.
unsigned sides_at(const Triangle& triangle, std::size_t i);

/// Fit of a triangle of the mesh if its corner v were at `to`, sampled at its sides there.
SurfaceFit fit_in_fan(const OperatorContext& context, TriangleId id, VertexId v, const Vec3& to,
                      const Anchor& at);

/// Fit of the triangles of a fan around v as they stand; the rim, which stays, is not sampled.
SurfaceFit fit_of_fan(const OperatorContext& context, VertexId v,
                      const std::vector<TriangleId>& fan);

/// Fit of triangles of the mesh as they stand.
SurfaceFit fit_of(const OperatorContext& context, const std::vector<TriangleId>& triangles);

/// Not turned away from the ideal surface, and within the tolerance of it.
bool fits_well(const SurfaceFit& fit);

/// What does not fit well may still be no worse than what it replaces.
Verdict compare_fits(const SurfaceFit& after, const SurfaceFit& before);

/// Whether `count` new surface triangles may replace what is there: not turned away from the ideal
/// surface and within the tolerance of it, or at least no worse in that than what is there.
/// `fit_of_new(k)` is the fit of one of them, `fit_of_old()` that of what is there. The latter is
/// asked for at the first misfit, and decides at once where it is none.
template <class FitOfNew, class FitOfOld>
Verdict judge_surface(std::size_t count, FitOfNew&& fit_of_new, FitOfOld&& fit_of_old) {
  SurfaceFit after;
  std::optional<SurfaceFit> before;
  for (std::size_t k = 0; k < count; ++k) {
    after.add(fit_of_new(k));
    if (!before && !fits_well(after)) before = fit_of_old();
    if (before && fits_well(*before)) break;
  }
  return before ? compare_fits(after, *before) : Verdict::kAccept;
}

}  // namespace cavea
