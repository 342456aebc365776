#include <algorithm>

#include "cavea/geometry/dihedral.h"
#include "cavea/operator/edge_collapse.h"
#include "cavea/operator/edge_star.h"
#include "cavea/operator/edge_swap.h"
#include "cavea/operator/face_swap.h"
#include "cavea/operator/reconnect.h"
#include "cavea/pass/passes.h"

namespace cavea {
namespace {

/// Face swaps of better tets succeed less than once in a thousand.
constexpr double kFaceSwapBelow = 0.5;

/// The edges of a tet by how often their swap succeeds, as ranks of their dihedral angles: of tets
/// of quality 0.6 to 0.7, 14% at the second largest, 2% at the fourth, 1.5% at the largest and the
/// third, below 1% at others (counted on three workloads).
constexpr int kPromise[6] = {1, 3, 0, 2, 4, 5};
/// Better tets are asked at the first of these edges only.
constexpr double kAllEdgesBelow = 0.6;
constexpr int kEdgesOfGoodTet = 2;

/// The quality worklist of one part. Each edge and face is asked once after anything around it has
/// changed: a tet is stamped when it changes and when it asks, and what an edge's shell asked after
/// its last change need not be asked again from another tet of the shell.
class QualityQueue {
 public:
  explicit QualityQueue(PartState& s) : s_(s), m_(s.mesh()) {
    const std::size_t n = m_.tets.size();
    changed_.assign(n, 0);
    asked_.assign(n, 1);
    touched_.assign(m_.points.size(), clock_);
    for (std::size_t t = 0; t < n; ++t)
      if (m_.tet_alive(TetId(t)) && (m_.tet_flags[t] & tet_flag::kAskSwap)) enqueue(TetId(t));
  }

  std::int64_t run() {
    ask_for_swaps();
    // One by one: the swaps that each makes possible come first.
    for (std::size_t i = 0; i < bad_.size(); ++i) {
      const auto [t, when] = bad_[i];
      if (m_.tet_alive(t) && asked_[t] == when) ask_last_resorts(t);
      ask_for_swaps();
    }
    return done_;
  }

 private:
  void ask_for_swaps() {
    for (; next_ < queue_.size(); ++next_) {
      const TetId t = queue_[next_];
      if (!m_.tet_alive(t) || !(m_.tet_flags[t] & tet_flag::kAskSwap)) continue;
      // Better tets keep their flag for a phase that asks them too.
      if (m_.qualities[t] >= s_.settings.swap_ceiling) continue;
      m_.tet_flags[t] &= std::uint8_t(~tet_flag::kAskSwap);
      ask(t);
    }
  }

  void enqueue(TetId t) {
    if (std::size_t(t) >= changed_.size())
      changed_.resize(std::size_t(t) + 1), asked_.resize(std::size_t(t) + 1);
    changed_[t] = clock_;
    asked_[t] = 0;
    for (const VertexId v : m_.tets[t]) {
      if (std::size_t(v) >= touched_.size()) touched_.resize(std::size_t(v) + 1);
      touched_[v] = clock_;
    }
    queue_.push_back(t);
  }

  bool asked_before(const std::vector<TetId>& tets) const {
    std::uint32_t asked = 0, changed = 0;
    for (TetId t : tets)
      asked = std::max(asked, asked_[t]), changed = std::max(changed, changed_[t]);
    return asked > changed;
  }

  /// The same without the shell, where a tet beside tells: what changes in the shell of an edge has
  /// both of its ends.
  bool surely_asked_before(TetId t, int i, int j) const {
    const std::uint32_t changed = std::min(touched_[m_.tets[t][i]], touched_[m_.tets[t][j]]);
    for (int f = 0; f < 4; ++f) {
      const FaceLink beside = m_.links[t][f];
      if (f != i && f != j && beside.is_tet() && asked_[beside.tet()] > changed) return true;
    }
    return false;
  }

  void committed() {
    s_.commit();
    ++done_;
    ++clock_;
    for (TetId t : s_.editor.created()) enqueue(t);
  }

  void ask(TetId t) {
    const double quality = m_.qualities[t];
    ++clock_;
    if (s_.settings.swap && swap(t, quality)) return;
    asked_[t] = clock_;
    if (is_bad(t) && !s_.last_resorts)
      m_.tet_flags[t] |= tet_flag::kAskSwap;
    else if (is_bad(t) || is_poor(t))
      bad_.emplace_back(t, clock_);
  }

  bool is_bad(TetId t) const { return m_.qualities[t] < s_.settings.repair_below; }
  bool is_poor(TetId t) const { return m_.qualities[t] < s_.settings.reconnect_below; }

  /// Of a tet that no swap has made better.
  void ask_last_resorts(TetId t) {
    ++clock_;
    if (is_bad(t) && s_.settings.collapse && collapse_for_quality(t)) return;
    if (is_poor(t) && s_.settings.swap && reconnect_for_quality(t)) return;
    if (is_bad(t) && s_.settings.insert && star_for_quality(t)) return;
    if (is_bad(t) && is_at_interface(t)) s_.block(t);
  }

  bool is_at_interface(TetId t) const {
    return std::ranges::any_of(m_.tets[t], [&](VertexId v) { return s_.at_interface(v); });
  }

  bool swap(TetId t, double quality) {
    const std::array<int, 6> edges = edges_by_dihedral(m_.corners(t));
    const int asked = quality < kAllEdgesBelow ? 6 : kEdgesOfGoodTet;
    for (int k = 0; k < asked; ++k) {
      const int* e = kEdgeVertices[edges[std::size_t(kPromise[k])]];
      if (swap_edge(t, e[0], e[1])) return true;
    }
    if (quality < kFaceSwapBelow)
      for (int f = 0; f < 4; ++f)
        if (swap_face(t, f)) return true;
    return false;
  }

  bool swap_edge(TetId t, int i, int j) {
    const VertexId a = m_.tets[t][i], b = m_.tets[t][j];
    if (s_.context.frozen_edge(a, b)) {
      if (s_.at_interface(a) && s_.at_interface(b)) s_.block(t);
      return false;
    }
    if (surely_asked_before(t, i, j)) return false;
    gather_shell(m_, t, i, j, s_.context.shell);
    if (asked_before(s_.context.shell.tets)) return false;
    const Verdict v = edge_swap(s_.context, s_.cavity);
    // The edge is free: the one on the surface that would come is not.
    if (v == Verdict::kFrozen && is_at_interface(t)) s_.block(t);
    if (!s_.takes(Operator::kEdgeSwap, v)) return false;
    committed();
    return true;
  }

  bool swap_face(TetId t, int f) {
    const FaceLink other = m_.links[t][f];
    if (other.is_cut()) s_.block(t);
    if (!other.is_tet()) return false;
    if (asked_[other.tet()] > std::max(changed_[t], changed_[other.tet()])) return false;
    if (!s_.takes(Operator::kFaceSwap, face_swap(s_.context, t, f, s_.cavity))) return false;
    committed();
    return true;
  }

  bool collapse_for_quality(TetId t) {
    for (const auto& e : kEdgeVertices)
      for (int way = 0; way < 2; ++way) {
        gather_shell(m_, t, e[way], e[1 - way], s_.context.shell);
        if (!s_.takes(Operator::kEdgeCollapse, edge_collapse(s_.context, true, s_.cavity)))
          continue;
        committed();
        return true;
      }
    return false;
  }

  bool reconnect_for_quality(TetId t) {
    const Verdict v = reconnect(s_.context, t, s_.settings.collapse, s_.cavity);
    if (!s_.takes(Operator::kReconnect, v)) return false;
    committed();
    return true;
  }

  bool star_for_quality(TetId t) {
    for (const auto& e : kEdgeVertices) {
      gather_shell(m_, t, e[0], e[1], s_.context.shell);
      const Verdict v = edge_star(s_.context, s_.editor.next_vertex(), s_.cavity);
      if (!s_.takes(Operator::kEdgeStar, v)) continue;
      committed();
      return true;
    }
    return false;
  }

  PartState& s_;
  TetMesh& m_;
  std::vector<TetId> queue_;
  std::size_t next_ = 0;
  std::vector<std::pair<TetId, std::uint32_t>> bad_;  ///< asked for swaps in vain, and when
  std::vector<std::uint32_t> changed_, asked_;
  std::vector<std::uint32_t> touched_;  ///< when a tet of the vertex has last changed
  std::uint32_t clock_ = 2;             ///< 0 and 1 stand for what was before
  std::int64_t done_ = 0;
};

}  // namespace

std::int64_t quality_pass(PartState& s) { return QualityQueue(s).run(); }

}  // namespace cavea
