#include "cavea/operator/surface_merge.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "cavea/base/keep_once.h"
#include "cavea/operator/merged_patch.h"
#include "cavea/operator/refit.h"
#include "cavea/operator/starred_hole.h"

namespace cavea {
namespace {

/// What closes a strip from one end leaves a tip at the next, as bad as what was there.
constexpr double kAboutAsGood = 0.9;
/// Of the worst quality, that is left where a tip is opened: few tets are around, and what is left
/// is no longer held by the angle.
constexpr double kMendable = 0.6;

/// What goes with the vertices and edges of a junction.
class Merge {
 public:
  Merge(OperatorContext& c, const Junction& j, double sound, VertexId m)
      : c_(c), j_(j), sound_(sound), m_(m) {}

  Verdict gather() {
    if (c_.limits.surface_frozen) return Verdict::kBreaksFeature;
    for (const VertexId v : j_.vertices)
      if (const Verdict verdict = gather_vertex(v); verdict != Verdict::kAccept) return verdict;
    for (const SurfaceSide& e : j_.edges)
      if (const Verdict verdict = gather_edge(e); verdict != Verdict::kAccept) return verdict;
    keep_once(triangles_);
    for (const TetId t : tets_)
      if (c_.mesh.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
    for (const TriangleId t : triangles_)
      if (c_.mesh.triangles[t].tags & tag::kRequired) return Verdict::kBreaksFeature;
    patch_.emplace(c_.mesh, j_, std::move(triangles_));
    return patch_->verdict();
  }

  Verdict fill(Cavity& cavity) {
    cavity.removed_triangles = patch_->triangles();
    make_vertex(cavity);
    if (const Verdict v = star_tets(cavity); v != Verdict::kAccept) return v;
    if (makes_long_edge(cavity)) return Verdict::kBadLength;
    cavity.triangles = patch_->star(m_);
    if (!keeps_references(cavity)) return Verdict::kBreaksFeature;
    std::vector<Anchor> hints;
    for (const VertexId v : j_.vertices) hints.push_back(c_.mesh.anchors[v]);
    return check_refit(c_, cavity, m_, hints);
  }

 private:
  Verdict gather_vertex(VertexId v) {
    const Tag tags = c_.tags(v);
    if (tags & tag::kFrozen) return Verdict::kFrozen;
    if (tags & tag::kPinched) return Verdict::kBreaksTopology;
    if (!(tags & tag::kSurface)) return Verdict::kNotNeeded;
    if (tags & kStays) return Verdict::kBreaksFeature;
    gather_ball(c_.mesh, v, c_.marker, c_.ball);
    if (c_.ball.cut) return Verdict::kFrozen;
    tets_.insert(tets_.end(), c_.ball.tets.begin(), c_.ball.tets.end());
    for_each_triangle(c_.mesh, c_.ball, [&](TriangleId t) { triangles_.push_back(t); });
    return Verdict::kAccept;
  }

  Verdict gather_edge(const SurfaceSide& e) {
    const Triangle& t = c_.mesh.triangles[e.triangle];
    const Tag tags = t.edge_tag[e.k];
    if (!(tags & tag::kFeature)) return Verdict::kNotNeeded;
    if (tags & (kStays | tag::kPinched)) return Verdict::kBreaksFeature;
    const TetId tet = t.sides[0].tet();
    gather_shell(c_.mesh, tet, c_.mesh.local_index(tet, t.v[(e.k + 1) % 3]),
                 c_.mesh.local_index(tet, t.v[(e.k + 2) % 3]), c_.shell);
    if (c_.shell.cut || c_.frozen_edge(c_.shell.p, c_.shell.q)) return Verdict::kFrozen;
    tets_.insert(tets_.end(), c_.shell.tets.begin(), c_.shell.tets.end());
    for (const Shell::At& at : c_.shell.triangles) triangles_.push_back(at.triangle);
    return Verdict::kAccept;
  }

  void make_vertex(Cavity& cavity) {
    float size = std::numeric_limits<float>::max();
    std::int32_t ref = 0;
    Anchor near;
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const VertexId v : j_.vertices) {
      size = std::min(size, c_.mesh.sizes[v]);
      if (const double d2 = distance2(c_.point(v), j_.place); d2 < nearest2)
        nearest2 = d2, near = c_.mesh.anchors[v], ref = c_.mesh.vertex_refs[v];
    }
    for (const SurfaceSide& e : j_.edges) {
      const Triangle& t = c_.mesh.triangles[e.triangle];
      std::array<Anchor, 3> hints;
      for (std::size_t k = 0; k < 3; ++k) {
        hints[k] = c_.mesh.anchors[t.v[k]];
        if (k != e.k) size = std::min(size, c_.mesh.sizes[t.v[k]]);
      }
      if (j_.vertices.empty()) near = c_.surface.place(j_.place, t.patch, hints).anchor;
    }
    cavity.inserts_vertex = true;
    cavity.vertex = {j_.place, size, patch_->vertex_tags(), ref, near};
  }

  Verdict star_tets(Cavity& cavity) const {
    const StarredHole hole(c_.mesh, tets_, patch_->triangles(), j_.place);
    const auto inside = hole.vertices_inside();
    if (!hole.is_whole() || !inside) return Verdict::kBreaksTopology;
    cavity.removed_tets = hole.tets();
    cavity.tets = hole.star(m_);
    const auto is_flat = [](const NewTet& n) { return n.quality < kFlat; };
    if (std::ranges::any_of(cavity.tets, is_flat)) return Verdict::kInverted;
    if (!is_gain(cavity)) return Verdict::kWorseQuality;
    cavity.removed_vertices = j_.vertices;  // those on the boundary are on the hull
    for (const VertexId v : *inside) {
      if (std::ranges::find(j_.vertices, v) != j_.vertices.end()) continue;
      if (c_.tags(v) & (tag::kSurface | kStays)) return Verdict::kBreaksTopology;
      cavity.removed_vertices.push_back(v);
    }
    return Verdict::kAccept;
  }

  bool is_gain(const Cavity& cavity) const {
    double before = 1, after = 1;
    std::size_t unsound_before = 0, unsound_after = 0;
    for (const TetId t : cavity.removed_tets) add(c_.mesh.qualities[t], before, unsound_before);
    for (const NewTet& n : cavity.tets) add(n.quality, after, unsound_after);
    if (after >= kQualityGain * before) return true;
    if (j_.vertices.empty()) return after >= kMendable * before;
    return j_.vertices.size() > 1 && unsound_after < unsound_before &&
           after >= kAboutAsGood * before;
  }
  void add(double quality, double& worst, std::size_t& unsound) const {
    worst = std::min(worst, quality);
    unsound += quality < sound_;
  }

  bool makes_long_edge(const Cavity& cavity) const {
    const double limit = kRelaxedLong * c_.limits.long_edge;
    return std::ranges::any_of(cavity.tets, [&](const NewTet& n) {
      return std::ranges::any_of(n.v, [&](VertexId v) {
        return v != m_ && length_exceeds(distance2(j_.place, c_.point(v)), cavity.vertex.size,
                                         c_.mesh.sizes[v], limit);
      });
    });
  }

  /// Whether what goes has left some of each reference that it had.
  bool keeps_references(const Cavity& cavity) const {
    std::vector<std::int32_t> tets, triangles, edges;
    for (const NewTet& n : cavity.tets) tets.push_back(n.ref);
    for (const Triangle& t : cavity.triangles) {
      triangles.push_back(t.ref);
      edges.insert(edges.end(), t.edge_ref.begin(), t.edge_ref.end());
    }
    for (std::vector<std::int32_t>* refs : {&tets, &triangles, &edges}) keep_once(*refs);
    const auto is_edge_kept = [&](std::int32_t ref) { return ref == 0 || is_in(edges, ref); };
    return std::ranges::all_of(tets_, [&](TetId t) { return is_in(tets, c_.mesh.tet_refs[t]); }) &&
           std::ranges::all_of(patch_->triangles(), [&](TriangleId id) {
             const Triangle& t = c_.mesh.triangles[id];
             return is_in(triangles, t.ref) && std::ranges::all_of(t.edge_ref, is_edge_kept);
           });
  }

  OperatorContext& c_;
  const Junction& j_;
  double sound_;
  VertexId m_;
  std::vector<TetId> tets_;
  std::vector<TriangleId> triangles_;
  std::optional<MergedPatch> patch_;
};

}  // namespace

Verdict surface_merge(OperatorContext& c, const Junction& junction, double sound,
                      VertexId vertex_id, Cavity& cavity) {
  cavity.clear();
  Merge merge(c, junction, sound, vertex_id);
  if (const Verdict v = merge.gather(); v != Verdict::kAccept) return v;
  return merge.fill(cavity);
}

}  // namespace cavea
