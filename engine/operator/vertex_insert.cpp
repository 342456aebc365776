#include "cavea/operator/vertex_insert.h"

#include <algorithm>
#include <cmath>

#include "cavea/geometry/quality.h"

namespace cavea {
namespace {

/// Larger cavities are those of a mesh that is far from Delaunay.
constexpr std::size_t kMostTets = 512;
constexpr int kMostSteps = 200;
constexpr int kMostShrinks = 20;

/// kNearest for its height above a surface triangle.
constexpr double kLowest = 0.4;

/// Flatter tets are hard to repair; where the mesh is Delaunay, hardly any is.
constexpr double kLeastQuality = 1e-4;

/// Whether p is inside the circumsphere of a positive tet or about on it: where points of lattices
/// are on common spheres and in common planes, the cavity is then what p sees all of. Whatever this
/// says, the cavity is proven by the qualities of its new tets.
bool in_sphere(const Vec3& p, const std::array<Vec3, 4>& tet) {
  constexpr double kOnSphere = 1e-9;  // rounding of points a thousandth of the mesh apart is 1e-12
  const Vec3 a = tet[0] - p, b = tet[1] - p, c = tet[2] - p, d = tet[3] - p;
  const Vec3 ab = cross(a, b), cd = cross(c, d);
  const double a2 = norm2(a), b2 = norm2(b), c2 = norm2(c), d2 = norm2(d);
  const double far2 = std::max(std::max(a2, b2), std::max(c2, d2));
  return a2 * dot(b, cd) - b2 * dot(a, cd) + c2 * dot(d, ab) - d2 * dot(c, ab) >
         -kOnSphere * far2 * far2 * std::sqrt(far2);
}

/// Whether p is clearly on the outer side of a face: where it is in its plane the tets on both
/// sides will do, and rounding must not send a walk to and fro.
bool beyond(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kInPlane = 1e-10;
  const Vec3 n = cross(b - a, c - a), d = p - a;
  const double height = dot(n, d);
  return height > 0 && height * height > kInPlane * kInPlane * norm2(n) * norm2(d);
}

}  // namespace

IdSet::IdSet(std::size_t most) {
  std::size_t size = 64;
  while (size < 4 * most) size *= 2;
  slots_.resize(size);
}

void IdSet::clear() {
  if (++epoch_ != 0) return;
  slots_.assign(slots_.size(), {});
  epoch_ = 1;
}

bool IdSet::insert(std::int32_t id) {
  Slot& s = slot(id);
  const bool was_in = s.in;
  s = {epoch_, id, true};
  return !was_in;
}

IdSet::Slot& IdSet::slot(std::int32_t id) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t i = std::uint32_t(id) * 0x9E3779B1u;
  i = (i ^ (i >> 15)) & mask;
  while (slots_[i].epoch == epoch_ && slots_[i].id != id) i = (i + 1) & mask;
  if (slots_[i].epoch != epoch_) slots_[i].in = false;
  return slots_[i];
}

VertexInsert::VertexInsert(const TetMesh& mesh, const Box& reach)
    : mesh_(mesh), reach_(reach), taken_(kMostTets), marked_(4 * kMostTets) {}

TetId VertexInsert::locate(VertexId from, const Vec3& p) const {
  if (!in_reach(from)) return kNone;
  TetId t = mesh_.vertex_tets[from], before = kNone;
  for (int step = 0; t != kNone && step < kMostSteps; ++step) {
    const auto x = mesh_.corners(t);
    TetId next = kNone;
    bool inside = true;
    for (int f = 0; f < 4 && next == kNone; ++f) {
      const int* fv = kFaceVertices[f];
      const Vec3& o = x[std::size_t(fv[0])];
      if (!beyond(p, o, x[std::size_t(fv[1])], x[std::size_t(fv[2])])) continue;
      inside = false;
      const FaceLink link = mesh_.links[t][f];
      if (!link.is_tet() || link.tet() == before) continue;
      const auto& k = mesh_.tets[t];
      if (in_reach(k[fv[0]]) || in_reach(k[fv[1]]) || in_reach(k[fv[2]])) next = link.tet();
    }
    if (inside) return t;
    before = t;
    t = next;
  }
  return kNone;
}

Verdict VertexInsert::may_take(TetId t) const {
  if (mesh_.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
  int required = 0;
  for (VertexId v : mesh_.tets[t]) {
    if (!in_reach(v)) return Verdict::kFrozen;
    required += (mesh_.vertex_tags[v] & tag::kOnRequiredEdge) != 0;
  }
  // An edge of it may be one that must stay.
  return required > 1 ? Verdict::kBreaksFeature : Verdict::kAccept;
}

bool VertexInsert::too_near(const NewVertex& x, TetId t) const {
  const auto& k = mesh_.tets[t];
  const double size2 = double(x.size) * x.size;
  for (VertexId v : k)
    if (distance2(mesh_.points[v], x.point) < kNearest * kNearest * size2) return true;
  for (int f = 0; f < 4; ++f) {
    if (!mesh_.links[t][f].is_triangle()) continue;
    const int* fv = kFaceVertices[f];
    const Vec3& o = mesh_.points[k[fv[0]]];
    const Vec3 n = cross(mesh_.points[k[fv[1]]] - o, mesh_.points[k[fv[2]]] - o);
    const double height = dot(n, o - x.point);
    if (height < 0 || height * height < kLowest * kLowest * size2 * norm2(n)) return true;
  }
  return false;
}

Verdict VertexInsert::grow(const NewVertex& x, TetId start) {
  tets_.assign(1, start);
  taken_.clear();
  taken_.insert(start);
  if (const Verdict v = may_take(start); v != Verdict::kAccept) return v;
  if (too_near(x, start)) return Verdict::kBadLength;
  for (std::size_t i = 0; i < tets_.size(); ++i)
    for (const FaceLink link : mesh_.links[tets_[i]]) {
      if (!link.is_tet() || taken_.contains(link.tet())) continue;
      const TetId t = link.tet();
      if (!in_sphere(x.point, mesh_.corners(t))) continue;
      const Verdict v = may_take(t);
      if (v == Verdict::kFrozen) return v;
      if (v != Verdict::kAccept) continue;
      if (too_near(x, t)) return Verdict::kBadLength;
      if (tets_.size() == kMostTets) return Verdict::kTooLarge;
      taken_.insert(t);
      tets_.push_back(t);
    }
  return Verdict::kAccept;
}

bool VertexInsert::sees(const Vec3& p, TetId t, Cavity& cavity) {
  const auto& k = mesh_.tets[t];
  for (int f = 0; f < 4; ++f) {
    const FaceLink link = mesh_.links[t][f];
    if (link.is_tet() && taken_.contains(link.tet())) continue;
    const int* fv = kFaceVertices[f];
    const VertexId a = k[fv[0]], b = k[fv[2]], c = k[fv[1]];
    const double q = tet_quality(mesh_.points[a], mesh_.points[b], mesh_.points[c], p);
    if (q < kLeastQuality) return false;
    cavity.tets.push_back({{a, b, c, kNone}, mesh_.tet_refs[t], float(q)});
  }
  return true;
}

Verdict VertexInsert::shrink(const Vec3& p, TetId start, Cavity& cavity) {
  for (int again = 0; again < kMostShrinks; ++again) {
    bool all = true;
    cavity.tets.clear();
    for (TetId t : tets_) {
      if (sees(p, t, cavity)) continue;
      if (t == start) return Verdict::kInverted;
      taken_.erase(t);
      all = false;
    }
    if (all) return Verdict::kAccept;
    keep_connected(start);
  }
  return Verdict::kInverted;
}

/// Of the tets that are still taken, keeps those reached from the start.
void VertexInsert::keep_connected(TetId start) {
  connected_.assign(1, start);
  marked_.clear();
  marked_.insert(start);
  for (std::size_t i = 0; i < connected_.size(); ++i)
    for (const FaceLink link : mesh_.links[connected_[i]])
      if (link.is_tet() && taken_.contains(link.tet()) && marked_.insert(link.tet()))
        connected_.push_back(link.tet());
  for (TetId t : tets_)
    if (!marked_.contains(t)) taken_.erase(t);
  tets_.swap(connected_);
}

bool VertexInsert::encloses_vertex(const Cavity& cavity) {
  marked_.clear();
  for (const NewTet& t : cavity.tets)
    for (int k = 0; k < 3; ++k) marked_.insert(t.v[std::size_t(k)]);
  for (TetId t : tets_)
    for (VertexId v : mesh_.tets[t])
      if (!marked_.contains(v)) return true;
  return false;
}

Verdict VertexInsert::operator()(const NewVertex& vertex, VertexId id, TetId start,
                                 Cavity& cavity) {
  cavity.clear();
  if (const Verdict v = grow(vertex, start); v != Verdict::kAccept) return v;
  if (const Verdict v = shrink(vertex.point, start, cavity); v != Verdict::kAccept) return v;
  if (encloses_vertex(cavity)) return Verdict::kBreaksTopology;
  for (NewTet& t : cavity.tets) t.v[3] = id;
  cavity.removed_tets = tets_;
  cavity.inserts_vertex = true;
  cavity.vertex = vertex;
  return Verdict::kAccept;
}

}  // namespace cavea
