#include "cavea/operator/merged_patch.h"

#include <algorithm>
#include <utility>

#include "cavea/base/keep_once.h"
#include "cavea/geometry/closest.h"

namespace cavea {
namespace {

bool is_on(const Vec3& p, const Vec3& a, const Vec3& b) {
  constexpr double kExact2 = 1e-18;  // of squared distances: rounding
  return closest_on_segment(p, a, b).distance2 <= kExact2 * distance2(a, b);
}

}  // namespace

MergedPatch::MergedPatch(const TetMesh& mesh, const Junction& junction,
                         std::vector<TriangleId> triangles)
    : mesh_(mesh), junction_(junction), triangles_(std::move(triangles)) {
  verdict_ = gather_sides();
}

/// The rim of the triangles that go, and what comes from it to the new vertex.
Verdict MergedPatch::gather_sides() {
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
    return s.features > 1 && !(mesh_.vertex_tags[s.end] & tag::kCorner);
  };
  return std::ranges::any_of(spokes_, is_left_over) ? Verdict::kBreaksFeature : Verdict::kAccept;
}

MergedPatch::Ends MergedPatch::ends_of(const SurfaceSide& side) const {
  const auto& v = mesh_.triangles[side.triangle].v;
  const auto [a, b] = std::minmax(v[(side.k + 1) % 3], v[(side.k + 2) % 3]);
  return {a, b};
}

/// Whether an edge of so many triangles that go comes to what the new vertex replaces, is cut, or
/// has no others.
bool MergedPatch::is_inner(const Side& side, int triangles) const {
  const auto is_cut = [&](const SurfaceSide& e) { return ends_of(e) == side.ends; };
  const Tag tags = mesh_.triangles[side.triangle].edge_tag[side.k];
  return is_vertex(side.ends[0]) || is_vertex(side.ends[1]) ||
         std::ranges::any_of(junction_.edges, is_cut) ||
         (triangles == 2 && !(tags & tag::kNonManifold));
}

/// What goes can be contracted, as what comes can; and what goes at a vertex of the rim hangs
/// together through edges: else what is near would be pinched.
bool MergedPatch::keeps_topology() const {
  std::vector<VertexId> rim;
  for (const Side& side : rim_) rim.insert(rim.end(), side.ends.begin(), side.ends.end());
  keep_once(rim);
  const auto vertices = int(junction_.vertices.size() + rim.size()),
             edges = int(inner_.size() + rim_.size());
  if (vertices - edges + int(triangles_.size()) != 1) return false;
  return std::ranges::all_of(rim, [&](VertexId v) { return pieces_at(v) == 1; });
}

/// Of what goes at a vertex: triangles and inner edges, less the places where they meet.
int MergedPatch::pieces_at(VertexId v) const {
  const auto joints = [&](const Ends& e) { return (e[0] == v || e[1] == v) && is_in(inner_, e); };
  auto pieces =
      int(std::ranges::count_if(inner_, [&](const Ends& e) { return e[0] == v || e[1] == v; }));
  for (const TriangleId t : triangles_) {
    const auto& corners = mesh_.triangles[t].v;
    if (std::ranges::find(corners, v) == corners.end()) continue;
    ++pieces;
    for (std::size_t k = 0; k < 3; ++k) pieces -= joints(ends_of({t, k}));
  }
  return pieces;
}

bool MergedPatch::is_vertex(VertexId v) const {
  return std::ranges::find(junction_.vertices, v) != junction_.vertices.end();
}

bool MergedPatch::add_spokes(const Side& side) {
  const Triangle& t = mesh_.triangles[side.triangle];
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

MergedPatch::Spoke& MergedPatch::spoke_to(VertexId end) {
  const auto at = std::ranges::find(spokes_, end, &Spoke::end);
  return at != spokes_.end() ? *at : spokes_.emplace_back(Spoke{end});
}

Tag MergedPatch::vertex_tags() const {
  Tag tags = tag::kSurface;
  for (const Spoke& s : spokes_) tags |= s.tags & tag::kOnCurve;
  const auto is_corner = [&](VertexId v) { return (mesh_.vertex_tags[v] & tag::kCorner) != 0; };
  if (std::ranges::any_of(junction_.vertices, is_corner)) return tags | tag::kCorner;
  if (tags & tag::kOnCurve) return is_along_curve() ? tags : Tag(tags | tag::kCorner);
  return tags | tag::kOffSurface;
}

/// Whether the new vertex has two edges of a curve, and leaves all curves that came to what it
/// replaces where they were.
bool MergedPatch::is_along_curve() const {
  const auto is_feature = [](const Spoke& s) { return (s.tags & tag::kFeature) != 0; };
  if (std::ranges::count_if(spokes_, is_feature) != 2) return false;
  const auto is_on_new = [&](VertexId v) {
    return std::ranges::any_of(spokes_, [&](const Spoke& s) {
      return is_feature(s) && is_on(mesh_.points[v], junction_.place, mesh_.points[s.end]);
    });
  };
  const auto is_on_old = [&](const SurfaceSide& e) {
    const auto& v = mesh_.triangles[e.triangle].v;
    return is_on(junction_.place, mesh_.points[v[(e.k + 1) % 3]], mesh_.points[v[(e.k + 2) % 3]]);
  };
  return std::ranges::all_of(junction_.edges, is_on_old) &&
         std::ranges::all_of(junction_.vertices, [&](VertexId v) {
           return !(mesh_.vertex_tags[v] & tag::kOnCurve) || is_on_new(v);
         });
}

MergedPatch::Spoke MergedPatch::spoke_at(VertexId end) const {
  const auto at = std::ranges::find(spokes_, end, &Spoke::end);
  return at != spokes_.end() ? *at : Spoke{end};
}

std::vector<Triangle> MergedPatch::star(VertexId apex) const {
  std::vector<Triangle> star;
  for (const Side& side : rim_) {
    Triangle t = mesh_.triangles[side.triangle];
    t.v[side.k] = apex;
    for (const std::size_t k : {(side.k + 1) % 3, (side.k + 2) % 3}) {
      // Opposite one end of the rim runs the edge from the new vertex to the other.
      const Spoke spoke = spoke_at(t.v[3 - side.k - k]);
      t.edge_tag[k] = spoke.tags, t.edge_ref[k] = spoke.ref;
    }
    star.push_back(t);
  }
  return star;
}

}  // namespace cavea
