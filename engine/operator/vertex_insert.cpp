#include "cavea/operator/vertex_insert.h"

#include <algorithm>
#include <cmath>

#include "cavea/geometry/quality.h"
#include "cavea/mesh/local.h"

namespace cavea {
namespace {

constexpr int kMostSteps = 200;
constexpr int kMostShrinks = 20;
/// Where more vertices are too near to one, the mesh was to be thinned first.
constexpr std::size_t kMostReplaced = 8;

/// kNearest for its height above a surface triangle.
constexpr double kLowest = 0.4;

/// Whether p is clearly on the outer side of a face: where it is in its plane the tets on both
/// sides will do, and rounding must not send a walk to and fro.
bool beyond(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr double kInPlane = 1e-10;
  const Vec3 n = cross(b - a, c - a), d = p - a;
  const double height = dot(n, d);
  return height > 0 && height * height > kInPlane * kInPlane * norm2(n) * norm2(d);
}

}  // namespace

VertexInsert::VertexInsert(const TetMesh& mesh, const Box& reach)
    : mesh_(mesh), reach_(reach), hole_(mesh) {}

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
      const auto& k = mesh_.tets[t];
      if (!in_reach(k[fv[0]]) && !in_reach(k[fv[1]]) && !in_reach(k[fv[2]])) continue;
      const FaceLink link = mesh_.links[t][f];
      if (link.is_tet() && link.tet() != before) next = link.tet();
    }
    if (inside) return t;
    before = t;
    t = next;
  }
  return kNone;
}

/// Whether the vertex may be there beside v, if that goes where it is too near.
bool VertexInsert::may_be_beside(const NewVertex& x, VertexId v) {
  const double least2 = kNearest * kNearest * (double(x.size) * x.size);
  if (distance2(mesh_.points[v], x.point) >= least2) return true;
  if (!(mesh_.vertex_tags[v] & tag::kReplaceable)) return false;
  if (std::ranges::find(replaced_, v) == replaced_.end()) replaced_.push_back(v);
  return true;
}

Verdict VertexInsert::may_take(const NewVertex& x, TetId t, int fresh) {
  if (mesh_.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
  const auto& k = mesh_.tets[t];
  const auto all = [&](auto&& holds) {
    return fresh < 4 ? holds(k[fresh]) : std::ranges::all_of(k, holds);
  };
  if (!all([&](VertexId v) { return in_reach(v); })) return Verdict::kFrozen;
  int required = 0;
  for (VertexId v : k) required += (mesh_.vertex_tags[v] & tag::kOnRequiredEdge) != 0;
  // An edge of it may be one that must stay.
  if (required > 1) return Verdict::kBreaksFeature;
  const bool far = all([&](VertexId v) { return may_be_beside(x, v); });
  return far && !near_surface(x, t) ? Verdict::kAccept : Verdict::kBadLength;
}

bool VertexInsert::near_surface(const NewVertex& x, TetId t) const {
  const auto& k = mesh_.tets[t];
  const double size2 = double(x.size) * x.size;
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

/// Adds the ball of a vertex to the first tets. Verdicts: kAccept, kFrozen where it is not within
/// reach, kTooLarge.
Verdict VertexInsert::add_ball(VertexId v) {
  if (!in_reach(v)) return Verdict::kFrozen;
  small_ball(mesh_, v, ball_);
  for (const TetId t : ball_) {
    const auto& k = mesh_.tets[t];
    if (!std::ranges::all_of(k, [&](VertexId w) { return in_reach(w); })) return Verdict::kFrozen;
    if (first_.size() >= DelaunayCavity::kMostTets) return Verdict::kTooLarge;
    if (std::int32_t& seen = is_first_[t]; seen == IdMap::kNew) seen = 0, first_.push_back(t);
  }
  return Verdict::kAccept;
}

/// Grows the cavity, with all tets of what it is to replace.
Verdict VertexInsert::grow(const NewVertex& vertex, TetId start) {
  const auto admit = [&](TetId t, int fresh) { return may_take(vertex, t, fresh); };
  first_ = {start};
  is_first_.clear();
  is_first_[start] = 0;
  replaced_.clear();
  // What the first tet tells is mostly all: then it grows once.
  for (const VertexId v : mesh_.tets[start])
    if (!may_be_beside(vertex, v)) return Verdict::kBadLength;
  for (std::size_t added = 0;;) {
    if (replaced_.size() > kMostReplaced) return Verdict::kTooLarge;
    for (; added < replaced_.size(); ++added)
      if (const Verdict v = add_ball(replaced_[added]); v != Verdict::kAccept) return v;
    const Verdict grown = hole_.grow(vertex.point, first_, admit);
    if (grown != Verdict::kAccept || replaced_.size() == added) return grown;
  }
}

Verdict VertexInsert::operator()(const NewVertex& vertex, VertexId id, TetId start,
                                 Cavity& cavity) {
  cavity.clear();
  if (const Verdict grown = grow(vertex, start); grown != Verdict::kAccept) return grown;
  cavity.removed_vertices = replaced_;
  bool all = false;
  for (int again = 0; again < kMostShrinks && !all; ++again)
    if (!hole_.shrink_once(
            vertex.point, DelaunayCavity::kLeastQuality, [](TriangleId) { return false; }, cavity,
            all))
      return Verdict::kInverted;
  if (!all) return Verdict::kInverted;
  if (hole_.encloses_vertex(cavity)) return Verdict::kBreaksTopology;
  for (NewTet& t : cavity.tets) t.v[3] = id;
  cavity.removed_tets = hole_.tets();
  hole_.link(cavity);
  cavity.inserts_vertex = true;
  cavity.vertex = vertex;
  return Verdict::kAccept;
}

}  // namespace cavea
