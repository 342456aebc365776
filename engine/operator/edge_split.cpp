#include "cavea/operator/edge_split.h"

#include <algorithm>

#include "cavea/surface/midpoint.h"

namespace cavea {
namespace {

/// Shares of the way from the straight midpoint to the surface that are tried in turn.
constexpr double kShares[] = {1, 0.5, 0.25, 0};

EdgeOnSurface edge_of(const TetMesh& m, const Shell& shell) {
  const TriangleId id = shell.triangles[0].triangle;
  const Triangle& t = m.triangles[id];
  for (int k = 0; k < 3; ++k)
    if (t.v[k] != shell.p && t.v[k] != shell.q) return {id, k, t.edge_tag[k], t.edge_ref[k]};
  return {};
}

}  // namespace

Verdict may_split(const OperatorContext& c, EdgeOnSurface& edge) {
  const Shell& s = c.shell;
  if (s.cut || c.frozen_edge(s.p, s.q)) return Verdict::kFrozen;
  for (TetId t : s.tets)
    if (c.mesh.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
  if (!s.on_surface()) return Verdict::kAccept;
  if (c.limits.surface_frozen) return Verdict::kBreaksFeature;
  for (const auto& at : s.triangles)
    if (c.mesh.triangles[at.triangle].tags & tag::kRequired) return Verdict::kBreaksFeature;
  edge = edge_of(c.mesh, s);
  if (edge.tags & tag::kPinched) return Verdict::kBreaksTopology;
  return edge.tags & tag::kRequired ? Verdict::kBreaksFeature : Verdict::kAccept;
}

namespace {

/// Qualities of the two halves of each tet of the shell with the vertex at x; the worst, or 0 when
/// one is flat.
double halves(const OperatorContext& c, const Vec3& x, std::vector<float>& qualities) {
  const Shell& s = c.shell;
  double worst = 1;
  qualities.clear();
  for (std::size_t i = 0; i < s.tets.size(); ++i) {
    const Vec3 r = c.point(s.ring_at(i)), t = c.point(s.ring_at(i + 1));
    for (int half = 0; half < 2; ++half) {
      const Vec3& p = half ? x : c.point(s.p);
      const Vec3& q = half ? c.point(s.q) : x;
      const double quality = tet_quality(p, q, r, t);
      if (quality < kFlat) return 0;
      qualities.push_back(float(quality));
      worst = std::min(worst, quality);
    }
  }
  return worst;
}

/// Whether a collapse of the vertex in its middle would leave an edge that is tolerated.
bool is_tolerated(const OperatorContext& c) {
  const Shell& s = c.shell;
  return c.length_exceeds(s.p, s.q, c.limits.long_edge) &&
         !c.length_exceeds(s.p, s.q, kToleratedLong * c.limits.long_edge);
}

bool makes_short_edge(const OperatorContext& c, const NewVertex& v, bool for_fit) {
  const Shell& s = c.shell;
  const auto is_short = [&](VertexId r, double limit) {
    return metric_length(distance(v.point, c.point(r)), v.size, c.mesh.sizes[r]) < limit;
  };
  double limit = c.limits.shortest_made;
  if (c.limits.leave_tolerated && !for_fit && is_tolerated(c)) {
    limit = std::max(limit, c.limits.short_edge);
    if (is_short(s.p, limit) || is_short(s.q, limit)) return true;
  }
  return std::ranges::any_of(s.ring, [&](VertexId r) { return is_short(r, limit); });
}

void fill(const OperatorContext& c, VertexId id, const EdgeOnSurface& edge, Cavity& cavity) {
  const Shell& s = c.shell;
  cavity.removed_tets = s.tets;
  for (std::size_t i = 0; i < s.tets.size(); ++i) {
    const std::int32_t ref = c.mesh.tet_refs[s.tets[i]];
    const VertexId r = s.ring_at(i), t = s.ring_at(i + 1);
    cavity.tets.push_back({{s.p, id, r, t}, ref, c.qualities[2 * i]});
    cavity.tets.push_back({{id, s.q, r, t}, ref, c.qualities[2 * i + 1]});
  }
  for (const auto& at : s.triangles) {
    const Triangle& old = c.mesh.triangles[at.triangle];
    cavity.removed_triangles.push_back(at.triangle);
    for (const VertexId gone : {s.p, s.q}) {
      Triangle t = old;
      const VertexId kept = gone == s.p ? s.q : s.p;
      for (int k = 0; k < 3; ++k) {
        if (old.v[k] == gone) t.v[k] = id;
        // Opposite the kept end runs the new edge from the vertex to the third; the edge opposite
        // `gone` stays, and half of the split edge lies opposite the third.
        if (old.v[k] == kept) t.edge_tag[k] = 0, t.edge_ref[k] = 0;
        if (old.v[k] != s.p && old.v[k] != s.q) t.edge_tag[k] = edge.tags, t.edge_ref[k] = edge.ref;
      }
      cavity.triangles.push_back(t);
    }
  }
}

}  // namespace

Verdict edge_split(OperatorContext& c, VertexId vertex_id, Cavity& cavity, bool for_fit) {
  cavity.clear();
  EdgeOnSurface edge;
  if (const Verdict v = may_split(c, edge); v != Verdict::kAccept) return v;
  double before = 1;
  for (TetId t : c.shell.tets) before = std::min(before, double(c.mesh.qualities[t]));
  NewVertex vertex = midpoint(c.mesh, c.surface, c.shell.p, c.shell.q, edge.triangle, edge.side);
  if (makes_short_edge(c, vertex, for_fit)) return Verdict::kBadLength;
  const Vec3 straight = (c.point(c.shell.p) + c.point(c.shell.q)) / 2, target = vertex.point;
  // Splitting a flat tet gives flat tets; only where all of them are sound need the halves be.
  double worst = 0;
  for (const double share : kShares) {
    vertex.point = straight + share * (target - straight);
    worst = halves(c, vertex.point, c.qualities);
    if (worst >= c.lowest_allowed(before) && worst > kFlat) break;
    if (share == 0 || target == straight)
      return worst <= kFlat ? Verdict::kInverted : Verdict::kWorseQuality;
    vertex.tags |= tag::kOffSurface;
  }
  cavity.inserts_vertex = true;
  cavity.vertex = vertex;
  fill(c, vertex_id, edge, cavity);
  return Verdict::kAccept;
}

}  // namespace cavea
