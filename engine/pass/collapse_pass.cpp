#include <algorithm>
#include <limits>

#include "cavea/operator/edge_collapse.h"
#include "cavea/pass/asked_edges.h"
#include "cavea/pass/passes.h"

namespace cavea {
namespace {

/// Lets vertices vanish along edges that are too short. Each vertex is asked once, for all of its
/// short edges, the shortest first: so its ball is gathered once.
class CollapsePass {
 public:
  explicit CollapsePass(PartState& s)
      : s_(s), m_(s.mesh()), shortest_(m_.points.size(), {kNotAsked, kNone}) {}

  std::int64_t run() {
    find_short_edges();
    if (!s_.slack)
      for (std::uint8_t& flags : m_.tet_flags) flags &= std::uint8_t(~tet_flag::kAskLength);
    std::int64_t done = 0;
    for (const VertexId v : vertices_in_order()) done += ask(v);
    return done;
  }

 private:
  static constexpr float kNotAsked = std::numeric_limits<float>::infinity();

  /// Of so many short edges at a vertex the best is good enough.
  static constexpr std::size_t kMostCompared = 8;

  struct ShortEdge {
    float length;
    TetId tet;  ///< one that has it
  };

  /// An edge from the vertex that is asked.
  struct Spoke {
    double length;
    VertexId to;
    TetId tet;
    double worst = 0;  ///< quality of the tets that a collapse along it would make
  };

  void find_short_edges() {
    const double limit = s_.context.limits.short_edge;
    for_each_asked_edge(
        m_, [&](LengthBlock & block) -> auto& { return block.perhaps_below(limit); },
        [&](TetId t, VertexId a, VertexId b) {
          if (!is_short(a, b)) return;
          const auto length = float(s_.context.length(std::min(a, b), std::max(a, b)));
          for (const VertexId v : {a, b})
            if (length < shortest_[v].length) shortest_[v] = {length, t};
        });
  }

  /// Those with the shortest edges first.
  std::vector<VertexId> vertices_in_order() const {
    std::vector<VertexId> order;
    for (std::size_t v = 0; v < shortest_.size(); ++v)
      if (shortest_[v].length < kNotAsked) order.push_back(VertexId(v));
    std::ranges::sort(order, [&](VertexId a, VertexId b) {
      return std::pair(shortest_[a].length, a) < std::pair(shortest_[b].length, b);
    });
    return order;
  }

  bool is_short(VertexId a, VertexId b) const {
    return !s_.context.length_exceeds(a, b, s_.context.limits.short_edge);
  }

  /// Whether v has vanished.
  bool ask(VertexId v) {
    if (!m_.vertex_alive(v)) return false;
    const TetId tet = shortest_[v].tet;
    if (m_.vertex_tags[v] & tag::kFrozen) {
      if (m_.tet_alive(tet)) s_.block(tet);
      s_.count(Operator::kEdgeCollapse, Verdict::kFrozen);
      return false;
    }
    gather_ball(m_, v, s_.context.marker, s_.context.ball);
    find_short_spokes();
    if (!(m_.vertex_tags[v] & tag::kSurface)) put_best_first();
    for (const Spoke& spoke : spokes_)
      if (collapse(spoke)) return true;
    return false;
  }

  void find_short_spokes() {
    const Ball& ball = s_.context.ball;
    // The surface only vanishes along itself.
    const Tag wanted = m_.vertex_tags[ball.v] & tag::kSurface;
    spokes_.clear();
    gather_around(s_.context);
    for (const auto& [to, tet] : s_.context.around)
      if ((m_.vertex_tags[to] & wanted) == wanted && is_short(ball.v, to))
        spokes_.push_back({s_.context.length(ball.v, to), to, tet});
    std::ranges::sort(spokes_, [](const Spoke& a, const Spoke& b) {
      return std::pair(a.length, a.to) < std::pair(b.length, b.to);
    });
  }

  /// Inside, where nothing but the new tets decides: so they stay good for long without swaps.
  void put_best_first() {
    if (spokes_.size() < 2) return;
    spokes_.resize(std::min(spokes_.size(), kMostCompared));
    const Ball& ball = s_.context.ball;
    Star& star = s_.context.star;
    prepare_star(s_.context);
    for (Spoke& spoke : spokes_) {
      star.evaluate(m_.points[spoke.to]);
      spoke.worst = 1;
      for (std::size_t i = 0; i < star.size(); ++i)
        if (star.qualities()[i] < spoke.worst && m_.local_index(ball.tets[i], spoke.to) == 4)
          spoke.worst = star.qualities()[i];
    }
    std::ranges::sort(spokes_, [](const Spoke& a, const Spoke& b) {
      return std::pair(-a.worst, a.to) < std::pair(-b.worst, b.to);
    });
    while (spokes_.size() > 1 && spokes_.back().worst < kFlat) spokes_.pop_back();
  }

  bool collapse(const Spoke& spoke) {
    gather_edge(spoke);
    const Verdict v = edge_collapse_of_ball(s_.context, false, s_.cavity);
    if (v == Verdict::kFrozen) s_.block(spoke.tet);
    if (!s_.takes(Operator::kEdgeCollapse, v)) return false;
    s_.commit();
    return true;
  }

  /// Inside, nobody asks for the ring.
  void gather_edge(const Spoke& spoke) {
    const VertexId v = s_.context.ball.v;
    Shell& shell = s_.context.shell;
    if (m_.vertex_tags[v] & tag::kSurface) {
      gather_shell(m_, spoke.tet, m_.local_index(spoke.tet, v), m_.local_index(spoke.tet, spoke.to),
                   shell);
    } else {
      shell.p = v, shell.q = spoke.to;
    }
  }

  PartState& s_;
  TetMesh& m_;
  std::vector<ShortEdge> shortest_;  ///< of each vertex, among the tets that are asked
  std::vector<Spoke> spokes_;
};

}  // namespace

std::int64_t collapse_pass(PartState& s) { return CollapsePass(s).run(); }

}  // namespace cavea
