#include "cavea/operator/surface_insert.h"

#include <algorithm>
#include <tuple>

#include "cavea/surface/midpoint.h"

namespace cavea {
namespace {

constexpr int kMostShrinks = 20;

/// Share of a flat shell's worst quality that new tets must have.
constexpr double kKeptQuality = 0.1;

/// Cosine of the largest angle between a triangle that vanishes and the one at the edge: new
/// triangles across a sharper bend would not fit it.
constexpr double kSmoothCosine = 0.9;

Vec3 normal_of(const TetMesh& m, const Triangle& t) {
  const Vec3 o = m.points[t.v[0]];
  return cross(m.points[t.v[1]] - o, m.points[t.v[2]] - o);
}

/// Whether x is in the circumcircle of a triangle or about on it, as seen in the triangle's plane
/// by distances.
bool in_circle(const Vec3& x, const Vec3& o, const Vec3& b, const Vec3& c) {
  constexpr double kOnCircle = 1e-9;  // as in_sphere(): what is in one plane goes together
  const Vec3 u = b - o, v = c - o, n = cross(u, v), p = x - o;
  // The center z fulfils 2 z . u = u^2, 2 z . v = v^2, z . n = 0; x is inside if x^2 < 2 x . z.
  const Vec3 z2n = norm2(u) * cross(v, n) + norm2(v) * cross(n, u);  // 2 z n^2
  return norm2(p) * norm2(n) <= dot(p, z2n) + kOnCircle * norm2(n) * (norm2(u) + norm2(v));
}

}  // namespace

Verdict SurfaceInsert::admit(TetId t) const {
  if (c_.mesh.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
  // An edge of it may be one that must stay.
  int kept = 0;
  for (const VertexId v : c_.mesh.tets[t])
    kept += (c_.tags(v) & (tag::kFrozen | tag::kOnRequiredEdge)) != 0;
  return kept > 1 ? Verdict::kBreaksFeature : Verdict::kAccept;
}

bool SurfaceInsert::is_open(TriangleId t) const { return sheet_of(t) >= 0; }

int SurfaceInsert::sheet_of(TriangleId t) const {
  for (const Opened& o : opened_)
    if (o.triangle == t) return o.sheet;
  return -1;
}

/// Whether all of a triangle's tets are in the hole.
bool SurfaceInsert::is_on_hole(const Triangle& t) const {
  return std::ranges::all_of(t.sides, [&](FaceLink side) {
    return side.is_unset() || (side.is_tet() && hole_.contains(side.tet()));
  });
}

/// Whether a triangle on the hole, but not at the edge, is one that may vanish, wherever it is
/// reached from: with all of its tets in the hole, and the vertex in its circumcircle.
bool SurfaceInsert::is_candidate(TriangleId id) {
  const Triangle& t = c_.mesh.triangles[id];
  if (t.tags & (tag::kRequired | tag::kFrozen)) return false;
  bool same_patch = false;
  for (const auto& at : c_.shell.triangles) {
    if (at.triangle == id) return false;
    same_patch |= c_.mesh.triangles[at.triangle].patch == t.patch;
  }
  return same_patch && is_on_hole(t) &&
         in_circle(vertex_.point, c_.point(t.v[0]), c_.point(t.v[1]), c_.point(t.v[2]));
}

/// The candidates and their sides.
void SurfaceInsert::collect_sides() {
  const TetMesh& m = c_.mesh;
  on_hole_.clear();
  for (const TetId t : hole_.tets())
    for (const FaceLink link : m.links[t])
      if (link.is_triangle() && is_candidate(link.triangle())) on_hole_.push_back(link.triangle());
  std::sort(on_hole_.begin(), on_hole_.end());
  on_hole_.erase(std::unique(on_hole_.begin(), on_hole_.end()), on_hole_.end());
  sides_.clear();
  for (const TriangleId id : on_hole_) {
    const auto& v = m.triangles[id].v;
    for (int k = 0; k < 3; ++k) {
      const VertexId a = v[std::size_t(k + 1) % 3], b = v[std::size_t(k + 2) % 3];
      sides_.push_back({std::min(a, b), std::max(a, b), id, k});
    }
  }
  std::sort(sides_.begin(), sides_.end(), [](const Side& x, const Side& y) {
    return std::tie(x.a, x.b, x.triangle) < std::tie(y.a, y.b, y.triangle);
  });
}

bool SurfaceInsert::may_open(TriangleId id, const Triangle& from, const Vec3& normal) const {
  const Triangle& t = c_.mesh.triangles[id];
  if (t.patch != from.patch || is_open(id)) return false;
  const Vec3 n = normal_of(c_.mesh, t);
  return dot(n, normal) >= kSmoothCosine * std::sqrt(norm2(n) * norm2(normal));
}

/// Opens what is reached from a triangle at the edge over smooth sides.
void SurfaceInsert::open_sheet(int sheet, TriangleId first) {
  const Vec3 normal = normal_of(c_.mesh, c_.mesh.triangles[first]);
  for (std::size_t i = 0; i < opened_.size(); ++i) {
    if (opened_[i].sheet != sheet) continue;
    const TriangleId id = opened_[i].triangle;
    const Triangle& t = c_.mesh.triangles[id];
    for (int k = 0; k < 3; ++k) {
      if (t.edge_tag[std::size_t(k)] & tag::kFeature) continue;
      const VertexId u = t.v[std::size_t(k + 1) % 3], w = t.v[std::size_t(k + 2) % 3];
      const VertexId a = std::min(u, w), b = std::max(u, w);
      if (a == std::min(c_.shell.p, c_.shell.q) && b == std::max(c_.shell.p, c_.shell.q)) continue;
      auto at =
          std::lower_bound(sides_.begin(), sides_.end(), std::tie(a, b),
                           [](const Side& s, const auto& key) { return std::tie(s.a, s.b) < key; });
      for (; at != sides_.end() && at->a == a && at->b == b; ++at)
        if (at->triangle != id && may_open(at->triangle, t, normal))
          opened_.push_back({at->triangle, sheet});
    }
  }
}

void SurfaceInsert::open_edge() {
  opened_.clear();
  int sheet = 0;
  for (const auto& at : c_.shell.triangles) opened_.push_back({at.triangle, sheet++});
}

/// Of a hole that was made smaller. \return whether there were others before
bool SurfaceInsert::drop_lost_sides() {
  const auto is_lost = [&](TriangleId id) { return !is_on_hole(c_.mesh.triangles[id]); };
  if (std::erase_if(on_hole_, is_lost) == 0) return false;
  std::erase_if(sides_, [&](const Side& s) { return is_lost(s.triangle); });
  return true;
}

void SurfaceInsert::open_sheets() {
  open_edge();
  if (on_hole_.empty()) return;
  const std::size_t sheets = opened_.size();
  for (std::size_t s = 0; s < sheets; ++s) open_sheet(int(s), opened_[s].triangle);
  if (!are_discs()) open_edge();
}

/// Whether a side of an open triangle has another one of the same sheet behind it, or is the edge
/// that is split.
bool SurfaceInsert::is_inner(const Triangle& t, int k, int sheet) const {
  const VertexId u = t.v[std::size_t(k + 1) % 3], w = t.v[std::size_t(k + 2) % 3];
  const VertexId p = c_.shell.p, q = c_.shell.q;
  if ((u == p && w == q) || (u == q && w == p)) return true;
  if (t.edge_tag[std::size_t(k)] & tag::kFeature) return false;
  for (const Opened& o : opened_) {
    const Triangle& s = c_.mesh.triangles[o.triangle];
    if (o.sheet != sheet || &s == &t) continue;
    const bool has_u = std::ranges::find(s.v, u) != s.v.end();
    if (has_u && std::ranges::find(s.v, w) != s.v.end()) return true;
  }
  return false;
}

/// Whether each sheet is a disc with all of its vertices on its rim, and no two of them meet but at
/// the edge.
bool SurfaceInsert::are_discs() {
  const int sheets = int(c_.shell.triangles.size());
  rim_.clear();
  for (int sheet = 0; sheet < sheets; ++sheet) {
    int triangles = 0, rim = 1;  // the edge itself
    for (const Opened& o : opened_) {
      if (o.sheet != sheet) continue;
      ++triangles;
      const Triangle& t = c_.mesh.triangles[o.triangle];
      for (int k = 0; k < 3; ++k) {
        if (is_inner(t, k, sheet)) continue;
        ++rim;
        rim_.push_back(t.v[std::size_t(k + 1) % 3]);
        rim_.push_back(t.v[std::size_t(k + 2) % 3]);
      }
    }
    // Of a disc with V vertices, F triangles and R sides of its rim: V = F/2 + R/2 + 1 and V = R.
    if (rim != triangles + 2) return false;
  }
  std::sort(rim_.begin(), rim_.end());
  for (std::size_t i = 0; i < rim_.size();) {
    const VertexId v = rim_[i];
    int times = 0;
    for (; i < rim_.size() && rim_[i] == v; ++i) ++times;
    if (times != (v == c_.shell.p || v == c_.shell.q ? sheets : 2)) return false;
  }
  return true;
}

void SurfaceInsert::add_triangles(const EdgeOnSurface& edge, VertexId id, Cavity& cavity) const {
  for (const Opened& o : opened_) {
    const Triangle& old = c_.mesh.triangles[o.triangle];
    cavity.removed_triangles.push_back(o.triangle);
    for (int k = 0; k < 3; ++k) {
      if (is_inner(old, k, o.sheet)) continue;
      Triangle t = old;
      t.v[std::size_t(k)] = id;
      for (const int i : {1, 2}) {
        // Opposite one end runs the side from the vertex to the other.
        const auto here = std::size_t(k + i) % 3, other = std::size_t(k + 3 - i) % 3;
        const bool half = t.v[other] == c_.shell.p || t.v[other] == c_.shell.q;
        t.edge_tag[here] = half ? edge.tags : Tag(0);
        t.edge_ref[here] = half ? edge.ref : 0;
      }
      cavity.triangles.push_back(t);
    }
  }
}

/// Whether the open triangles are in one plane with the vertex, to a hundredth of the tolerance:
/// then the new ones are the same surface.
bool SurfaceInsert::is_flat() const {
  constexpr double kFlatShare = 0.01;
  const double most2 = kFlatShare * kFlatShare * c_.tolerance2(vertex_.anchor);
  for (const Opened& o : opened_) {
    const Triangle& t = c_.mesh.triangles[o.triangle];
    const Triangle& first = c_.mesh.triangles[c_.shell.triangles[std::size_t(o.sheet)].triangle];
    const Vec3 normal = normalized(normal_of(c_.mesh, first));
    for (const VertexId v : t.v) {
      const double height = dot(normal, c_.point(v) - vertex_.point);
      if (height * height > most2) return false;
    }
  }
  return true;
}

/// What other triangles than those at the edge are replaced by must fit the surface.
Verdict SurfaceInsert::judge(VertexId id, const Cavity& cavity) const {
  if (cavity.removed_triangles.size() == c_.shell.triangles.size() || is_flat())
    return Verdict::kAccept;
  const auto fit_of_new = [&](std::size_t i) {
    const Triangle& t = cavity.triangles[i];
    std::array<Vec3, 3> x;
    std::array<Anchor, 3> hints;
    for (std::size_t k = 0; k < 3; ++k) {
      x[k] = t.v[k] == id ? vertex_.point : c_.point(t.v[k]);
      hints[k] = t.v[k] == id ? vertex_.anchor : c_.mesh.anchors[t.v[k]];
    }
    return fit_triangle(c_, x, t.patch, hints);
  };
  return judge_surface(cavity.triangles.size(), fit_of_new,
                       [&] { return fit_of(c_, cavity.removed_triangles); });
}

Verdict SurfaceInsert::grow() {
  const auto& shell = c_.shell.tets;
  std::size_t checked = 0;  // the shell is always taken, whatever its edges: these stay
  return hole_.grow(vertex_.point, shell, [&](TetId t, int) {
    return checked++ < shell.size() ? Verdict::kAccept : admit(t);
  });
}

/// From flat tets flat ones may come, but no flatter than a share of what was.
double SurfaceInsert::least_quality() const {
  double before = 1;
  for (const TetId t : c_.shell.tets) before = std::min(before, double(c_.mesh.qualities[t]));
  return std::max(kFlat, std::min(DelaunayCavity::kLeastQuality, kKeptQuality * before));
}

/// Of all that was grown.
Verdict SurfaceInsert::try_cavity(const EdgeOnSurface& edge, VertexId id, bool wide,
                                  Cavity& cavity) {
  cavity.clear();
  const double least = least_quality();
  if (wide)
    collect_sides();
  else
    on_hole_.clear();
  open_sheets();
  bool all = false;
  for (int again = 0; again < kMostShrinks && !all; ++again) {
    if (again > 0 && drop_lost_sides()) open_sheets();
    if (!hole_.shrink_once(
            vertex_.point, least, [&](TriangleId t) { return is_open(t); }, cavity, all))
      return Verdict::kInverted;
  }
  if (!all) return Verdict::kInverted;
  if (hole_.encloses_vertex(cavity)) return Verdict::kBreaksTopology;
  add_triangles(edge, id, cavity);
  return judge(id, cavity);
}

Verdict SurfaceInsert::operator()(VertexId id, Cavity& cavity) {
  EdgeOnSurface edge;
  if (const Verdict v = may_split(c_, edge); v != Verdict::kAccept) return v;
  if (!c_.shell.on_surface()) return Verdict::kNotNeeded;
  vertex_ = midpoint(c_.mesh, c_.surface, c_.shell.p, c_.shell.q, edge.triangle, edge.side);
  if (const Verdict v = grow(); v != Verdict::kAccept) return v;
  Verdict v = try_cavity(edge, id, true, cavity);
  if (v != Verdict::kAccept) {
    hole_.restore();
    v = try_cavity(edge, id, false, cavity);
  }
  if (v != Verdict::kAccept) return v;
  for (NewTet& t : cavity.tets) t.v[3] = id;
  cavity.removed_tets = hole_.tets();
  cavity.inserts_vertex = true;
  cavity.vertex = vertex_;
  return Verdict::kAccept;
}

}  // namespace cavea
