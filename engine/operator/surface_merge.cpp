#include "cavea/operator/surface_merge.h"

#include <algorithm>
#include <tuple>

#include "cavea/geometry/closest.h"
#include "cavea/operator/refit.h"
#include "cavea/operator/starred_hole.h"

namespace cavea {
namespace {

/// Edges may become this many times too long.
constexpr double kRelaxedLong = 1.4;

/// What closes a strip from one end leaves a tip at the next, as bad as what was there.
constexpr double kAboutAsGood = 0.9;
/// Of the worst quality, that is left where a tip is opened: few tets are around, and what is left
/// is no longer held by the angle.
constexpr double kMendable = 0.6;

/// What must have nothing of this.
constexpr Tag kStays = tag::kRequired | tag::kOnRequiredEdge | tag::kGiven;

using Ends = std::array<VertexId, 2>;

template <class T>
void keep_once(std::vector<T>& all) {
  std::ranges::sort(all);
  all.erase(std::ranges::unique(all).begin(), all.end());
}

template <class T>
bool is_in(const std::vector<T>& sorted, const T& item) {
  return std::ranges::binary_search(sorted, item);
}

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
    keep_once(tets_);
    keep_once(triangles_);
    for (const TetId t : tets_)
      if (c_.mesh.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
    for (const TriangleId t : triangles_)
      if (c_.mesh.triangles[t].tags & tag::kRequired) return Verdict::kBreaksFeature;
    return gather_sides();
  }

  Verdict fill(Cavity& cavity) {
    cavity.removed_triangles = triangles_;
    make_vertex(cavity);
    if (const Verdict v = star_tets(cavity); v != Verdict::kAccept) return v;
    if (makes_long_edge(cavity)) return Verdict::kBadLength;
    star_triangles(cavity);
    if (!keeps_references(cavity)) return Verdict::kBreaksFeature;
    std::vector<Anchor> hints;
    for (const VertexId v : j_.vertices) hints.push_back(c_.mesh.anchors[v]);
    return check_refit(c_, cavity, m_, hints);
  }

 private:
  /// An edge of a triangle that goes, smaller end first.
  struct Side {
    Ends ends;
    TriangleId triangle;
    std::size_t k;

    std::tuple<VertexId, VertexId, TriangleId> key() const { return {ends[0], ends[1], triangle}; }
  };
  struct Spoke {
    VertexId end = kNone;
    Tag tags = 0;
    std::int32_t ref = 0;
    int features = 0;
  };

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

  /// The rim of the triangles that go, and what comes from it to the new vertex.
  Verdict gather_sides() {
    std::vector<Side> sides;
    for (const TriangleId t : triangles_)
      for (std::size_t k = 0; k < 3; ++k) sides.push_back({ends_of({t, k}), t, k});
    std::ranges::sort(sides, {}, &Side::key);
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
      for (end = i + 1; end < sides.size() && sides[end].ends == sides[i].ends;) ++end;
      if (is_inner(sides[i], int(end - i))) {
        if (!add_spokes(sides[i])) return Verdict::kBreaksFeature;
        inner_.push_back(sides[i].ends);
      } else if (end - i > 1) {
        return Verdict::kBreaksTopology;  // two triangles that would come to the same place
      } else {
        rim_.push_back(sides[i]);
      }
    }
    if (!keeps_topology()) return Verdict::kBreaksTopology;
    // A curve that ended in itself.
    const auto is_left_over = [&](const Spoke& s) {
      return s.features > 1 && !(c_.tags(s.end) & tag::kCorner);
    };
    return std::ranges::any_of(spokes_, is_left_over) ? Verdict::kBreaksFeature : Verdict::kAccept;
  }

  Ends ends_of(const SurfaceSide& side) const {
    const auto& v = c_.mesh.triangles[side.triangle].v;
    const auto [a, b] = std::minmax(v[(side.k + 1) % 3], v[(side.k + 2) % 3]);
    return {a, b};
  }

  /// Whether an edge of so many triangles that go comes to what the new vertex replaces, is cut, or
  /// has no others.
  bool is_inner(const Side& side, int triangles) const {
    const auto is_cut = [&](const SurfaceSide& e) { return ends_of(e) == side.ends; };
    const Tag tags = c_.mesh.triangles[side.triangle].edge_tag[side.k];
    return is_vertex(side.ends[0]) || is_vertex(side.ends[1]) ||
           std::ranges::any_of(j_.edges, is_cut) || (triangles == 2 && !(tags & tag::kNonManifold));
  }

  /// What goes can be contracted, as what comes can; and what goes at a vertex of the rim hangs
  /// together through edges: else what is near would be pinched.
  bool keeps_topology() {
    std::vector<VertexId> rim;
    for (const Side& side : rim_) rim.insert(rim.end(), side.ends.begin(), side.ends.end());
    keep_once(rim);
    const auto vertices = int(j_.vertices.size() + rim.size()),
               edges = int(inner_.size() + rim_.size());
    if (vertices - edges + int(triangles_.size()) != 1) return false;
    return std::ranges::all_of(rim, [&](VertexId v) { return pieces_at(v) == 1; });
  }

  /// Of what goes at a vertex: triangles and inner edges, less the places where they meet.
  int pieces_at(VertexId v) const {
    const auto joints = [&](const Ends& e) { return (e[0] == v || e[1] == v) && is_in(inner_, e); };
    auto pieces =
        int(std::ranges::count_if(inner_, [&](const Ends& e) { return e[0] == v || e[1] == v; }));
    for (const TriangleId t : triangles_) {
      const auto& corners = c_.mesh.triangles[t].v;
      if (std::ranges::find(corners, v) == corners.end()) continue;
      ++pieces;
      for (std::size_t k = 0; k < 3; ++k) pieces -= joints(ends_of({t, k}));
    }
    return pieces;
  }

  bool is_vertex(VertexId v) const {
    return std::ranges::find(j_.vertices, v) != j_.vertices.end();
  }

  bool add_spokes(const Side& side) {
    const Triangle& t = c_.mesh.triangles[side.triangle];
    const Tag tags = t.edge_tag[side.k];
    if (tags & (kStays | tag::kPinched)) return false;
    for (const VertexId end : side.ends) {
      if (is_vertex(end)) continue;
      Spoke& spoke = spoke_to(end);
      spoke.tags |= tags;
      spoke.features += (tags & tag::kFeature) != 0;
      if (t.edge_ref[side.k] != 0) spoke.ref = t.edge_ref[side.k];
    }
    return true;
  }

  Spoke& spoke_to(VertexId end) {
    const auto at = std::ranges::find(spokes_, end, &Spoke::end);
    return at != spokes_.end() ? *at : spokes_.emplace_back(Spoke{end});
  }

  void make_vertex(Cavity& cavity) {
    float size = std::numeric_limits<float>::max();
    Anchor near;
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const VertexId v : j_.vertices) {
      size = std::min(size, c_.mesh.sizes[v]);
      if (const double d2 = distance2(c_.point(v), j_.place); d2 < nearest2)
        nearest2 = d2, near = c_.mesh.anchors[v];
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
    cavity.vertex = {j_.place, size, vertex_tags(), 0, near};
  }

  /// A corner on curves, lest it goes farther from where they were, unless it leaves them there.
  Tag vertex_tags() const {
    Tag tags = tag::kSurface;
    for (const Spoke& s : spokes_) tags |= s.tags & tag::kOnCurve;
    const auto is_corner = [&](VertexId v) { return (c_.tags(v) & tag::kCorner) != 0; };
    if (std::ranges::any_of(j_.vertices, is_corner)) return tags | tag::kCorner;
    if (tags & tag::kOnCurve) return is_along_curve() ? tags : Tag(tags | tag::kCorner);
    return tags | tag::kOffSurface;
  }

  /// Whether the new vertex has two edges of a curve, and leaves all curves that came to what it
  /// replaces where they were.
  bool is_along_curve() const {
    const auto is_feature = [](const Spoke& s) { return (s.tags & tag::kFeature) != 0; };
    if (std::ranges::count_if(spokes_, is_feature) != 2) return false;
    const auto is_on_new = [&](VertexId v) {
      return std::ranges::any_of(spokes_, [&](const Spoke& s) {
        return is_feature(s) && is_on(c_.point(v), j_.place, c_.point(s.end));
      });
    };
    const auto is_on_old = [&](const SurfaceSide& e) {
      const auto& v = c_.mesh.triangles[e.triangle].v;
      return is_on(j_.place, c_.point(v[(e.k + 1) % 3]), c_.point(v[(e.k + 2) % 3]));
    };
    return std::ranges::all_of(j_.edges, is_on_old) &&
           std::ranges::all_of(j_.vertices, [&](VertexId v) {
             return !(c_.tags(v) & tag::kOnCurve) || is_on_new(v);
           });
  }

  static bool is_on(const Vec3& p, const Vec3& a, const Vec3& b) {
    constexpr double kExact2 = 1e-18;  // of squared distances: rounding
    return closest_on_segment(p, a, b).distance2 <= kExact2 * distance2(a, b);
  }

  Verdict star_tets(Cavity& cavity) const {
    const StarredHole hole(c_.mesh, tets_, triangles_, j_.place);
    const auto inside = hole.vertices_inside();
    if (!hole.is_whole() || !inside) return Verdict::kBreaksTopology;
    cavity.removed_tets = hole.tets();
    cavity.tets = hole.star(m_);
    const auto is_flat = [](const NewTet& n) { return n.quality < kFlat; };
    if (std::ranges::any_of(cavity.tets, is_flat)) return Verdict::kInverted;
    if (!is_gain(cavity)) return Verdict::kWorseQuality;
    cavity.removed_vertices = j_.vertices;  // those on the boundary are on the hull
    for (const VertexId v : *inside) {
      if (is_vertex(v)) continue;
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
           std::ranges::all_of(triangles_, [&](TriangleId id) {
             const Triangle& t = c_.mesh.triangles[id];
             return is_in(triangles, t.ref) && std::ranges::all_of(t.edge_ref, is_edge_kept);
           });
  }

  void star_triangles(Cavity& cavity) {
    for (const Side& side : rim_) {
      Triangle t = c_.mesh.triangles[side.triangle];
      t.v[side.k] = m_;
      for (const std::size_t k : {(side.k + 1) % 3, (side.k + 2) % 3}) {
        // Opposite one end of the rim runs the edge from the new vertex to the other.
        const Spoke& spoke = spoke_to(t.v[3 - side.k - k]);
        t.edge_tag[k] = spoke.tags, t.edge_ref[k] = spoke.ref;
      }
      cavity.triangles.push_back(t);
    }
  }

  OperatorContext& c_;
  const Junction& j_;
  double sound_;
  VertexId m_;
  std::vector<TetId> tets_;
  std::vector<TriangleId> triangles_;
  std::vector<Side> rim_;
  std::vector<Ends> inner_;  ///< edges that go, sorted
  std::vector<Spoke> spokes_;
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
