#include "cavea/operator/reconnect.h"

#include <algorithm>

#include "cavea/cavity/pieces.h"
#include "cavea/operator/small_polyhedron.h"

namespace cavea {
namespace {

/// Marot and Remacle stop at 32 tets too: the fillings of larger ones are too many to search.
constexpr std::size_t kMaxCavity = 32;

/// Vertices that nothing may remove.
constexpr Tag kStays = tag::kSurface | tag::kCorner | tag::kRequired | tag::kFrozen |
                       tag::kOnRequiredEdge | tag::kPinched;

/// Whether an operation may remove a tet, and why not.
Verdict may_go(const OperatorContext& c, TetId t) {
  if (c.mesh.tet_flags[t] & tet_flag::kRequired) return Verdict::kBreaksFeature;
  for (const auto& e : kEdgeVertices)
    if (c.frozen_edge(c.mesh.tets[t][e[0]], c.mesh.tets[t][e[1]])) return Verdict::kFrozen;
  return Verdict::kAccept;
}

/// The tets around a bad one, and the polyhedron that they are.
class GrowingCavity {
 public:
  GrowingCavity(OperatorContext& c, TetId seed, bool removes_vertex, std::vector<TetId>& tets)
      : context_(c),
        mesh_(c.mesh),
        polyhedron_(c.polyhedron),
        tets_(tets),
        removes_vertex_(removes_vertex) {
    polyhedron_.clear();
    tets_.clear();
    add(seed);
  }

  /// Adds a tet, and then all those that need no new vertex; false if none may be added.
  bool grow() {
    const TetId next = best_neighbor();
    if (next == kNone) return false;
    add(next);
    while (tets_.size() < kMaxCavity) {
      const TetId inner = neighbor_without_new_vertex();
      if (inner == kNone) break;
      add(inner);
    }
    return true;
  }

  bool improve() {
    const float threshold = float(std::max(kFlat, kQualityGain * worst_));
    return polyhedron_.ceiling() > threshold && polyhedron_.search(threshold, kept());
  }

  void fill(Cavity& cavity) const {
    const std::int32_t ref = mesh_.tet_refs[tets_[0]];
    std::uint32_t used = 0;
    for (const auto& t : polyhedron_.filling()) {
      std::array<VertexId, 4> v;
      for (std::size_t k = 0; k < 4; ++k) v[k] = ids_[t[k]], used |= 1u << t[k];
      cavity.tets.push_back({v, ref, float(context_.quality(v[0], v[1], v[2], v[3]))});
    }
    for (int i = 0; i < polyhedron_.vertices(); ++i)
      if (!(used >> i & 1)) cavity.removed_vertices = {ids_[std::size_t(i)]};
  }

 private:
  int local(VertexId v) const {
    for (int i = 0; i < polyhedron_.vertices(); ++i)
      if (ids_[std::size_t(i)] == v) return i;
    return -1;
  }

  void add(TetId t) {
    SmallPolyhedron::Tet corners;
    for (std::size_t k = 0; k < 4; ++k) {
      const VertexId v = mesh_.tets[t][k];
      int i = local(v);
      if (i < 0) {
        i = polyhedron_.add_vertex(context_.point(v));
        ids_[std::size_t(i)] = v;
      }
      corners[k] = std::uint8_t(i);
    }
    polyhedron_.add_tet(corners);
    tets_.push_back(t);
    worst_ = std::min(worst_, double(mesh_.qualities[t]));
  }

  bool has(TetId t) const { return std::find(tets_.begin(), tets_.end(), t) != tets_.end(); }

  /// A triangle inside of the volume must not get tets of the cavity on both sides: the way around
  /// its edge may lead there.
  bool closes_on_triangle(TetId t) const {
    for (int k = 0; k < 4; ++k) {
      if (!mesh_.links[t][k].is_triangle()) continue;
      const FaceLink behind = mesh_.across(t, k);
      if (behind.is_tet() && has(behind.tet())) return true;
    }
    return false;
  }

  bool may_add(TetId t) const {
    return !has(t) && may_go(context_, t) == Verdict::kAccept && !closes_on_triangle(t);
  }

  /// Calls f(tet inside, its face, tet outside) for each face that the cavity may grow across.
  template <class F>
  void for_each_way_out(F&& f) const {
    for (const TetId t : tets_)
      for (int k = 0; k < 4; ++k) {
        const FaceLink out = mesh_.links[t][k];
        if (out.is_tet() && may_add(out.tet())) f(t, k, out);
      }
  }

  TetId neighbor_without_new_vertex() const {
    TetId found = kNone;
    for_each_way_out([&](TetId, int, FaceLink out) {
      if (found == kNone && local(mesh_.tets[out.tet()][out.face()]) >= 0) found = out.tet();
    });
    return found;
  }

  /// Behind the face over which no vertex of the cavity makes a good tet.
  TetId best_neighbor() const {
    if (polyhedron_.vertices() == SmallPolyhedron::kMaxVertices || tets_.size() >= kMaxCavity)
      return kNone;
    TetId found = kNone;
    float lowest = 2;
    for_each_way_out([&](TetId t, int k, FaceLink out) {
      const auto& v = mesh_.tets[t];
      const int* f = kFaceVertices[k];
      const float here = polyhedron_.ceiling(local(v[f[0]]), local(v[f[1]]), local(v[f[2]]));
      if (here < lowest) lowest = here, found = out.tet();
    });
    return found;
  }

  std::uint32_t kept() const {
    std::uint32_t bits = 0;
    for (int i = 0; i < polyhedron_.vertices(); ++i)
      if (!removes_vertex_ || (context_.tags(ids_[std::size_t(i)]) & kStays)) bits |= 1u << i;
    return bits;
  }

  OperatorContext& context_;
  const TetMesh& mesh_;
  SmallPolyhedron& polyhedron_;
  std::vector<TetId>& tets_;
  std::array<VertexId, SmallPolyhedron::kMaxVertices> ids_;
  const bool removes_vertex_;
  double worst_ = 1;
};

}  // namespace

Verdict reconnect(OperatorContext& c, TetId t, bool removes_vertex, Cavity& cavity) {
  cavity.clear();
  if (const Verdict v = may_go(c, t); v != Verdict::kAccept) return v;
  GrowingCavity growing(c, t, removes_vertex, cavity.removed_tets);
  while (growing.grow())
    if (growing.improve()) {
      growing.fill(cavity);
      return keeps_balls(c.mesh, cavity) ? Verdict::kAccept : Verdict::kBreaksTopology;
    }
  return Verdict::kWorseQuality;
}

}  // namespace cavea
