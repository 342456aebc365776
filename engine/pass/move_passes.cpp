#include <algorithm>

#include "cavea/operator/relocate.h"
#include "cavea/pass/passes.h"

namespace cavea {
namespace {

/// Shaking leaves no tet worse than this; swaps and relocations mend it easily.
constexpr double kShakenFloor = 0.3;

/// The balls of chosen vertices, by one walk over all tets: moves leave them as they are. For many
/// vertices that is cheaper than to gather each.
class Balls {
 public:
  Balls(const TetMesh& m, const std::vector<char>& chosen) : first_(m.points.size() + 1, 0) {
    auto for_each_corner = [&](auto&& f) {
      for (std::size_t t = 0; t < m.tets.size(); ++t)
        if (m.tet_alive(TetId(t)))
          for (const VertexId v : m.tets[t])
            if (chosen[v]) f(v, TetId(t));
    };
    for_each_corner([&](VertexId v, TetId) { ++first_[std::size_t(v) + 1]; });
    for (std::size_t v = 1; v < first_.size(); ++v) first_[v] += first_[v - 1];
    tets_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for_each_corner([&](VertexId v, TetId t) { tets_[next[v]++] = t; });
  }

  void get(VertexId v, Ball& ball) const {
    ball.v = v;
    ball.cut = false;
    ball.tets.assign(tets_.begin() + first_[v], tets_.begin() + first_[std::size_t(v) + 1]);
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<TetId> tets_;
};

/// The vertices of the tets that are asked, but frozen ones; takes the flags of these tets.
std::vector<char> take_asked(PartState& s) {
  TetMesh& m = s.mesh();
  std::vector<char> asked(m.points.size(), 0);
  for (std::size_t t = 0; t < m.tets.size(); ++t) {
    if (!m.tet_alive(TetId(t)) || !(m.tet_flags[t] & tet_flag::kAskMove)) continue;
    if (m.qualities[t] > s.settings.move_ceiling) continue;
    m.tet_flags[t] &= std::uint8_t(~tet_flag::kAskMove);
    for (const VertexId v : m.tets[t]) {
      if (s.at_interface(v))
        s.block(TetId(t));
      else
        asked[v] = 1;
    }
  }
  return asked;
}

/// Interior vertices whose balls are on the average worse than `below`.
std::vector<char> in_poor_balls(const TetMesh& m, double below) {
  std::vector<float> excess(m.points.size(), 0);
  for (std::size_t t = 0; t < m.tets.size(); ++t)
    if (m.tet_alive(TetId(t)))
      for (const VertexId v : m.tets[t]) excess[v] += m.qualities[t] - float(below);
  std::vector<char> poor(m.points.size());
  for (std::size_t v = 0; v < poor.size(); ++v)
    poor[v] = excess[v] < 0 && m.vertex_alive(VertexId(v)) &&
              !(m.vertex_tags[v] & (tag::kFrozen | tag::kSurface));
  return poor;
}

/// Offers chosen vertices, whose ball is in the context, a place: f(v, to) tells whether to take
/// it.
template <class F>
std::int64_t move_chosen(PartState& s, const std::vector<char>& chosen, F&& f) {
  if (std::ranges::find(chosen, 1) == chosen.end()) return 0;
  const Balls balls(s.mesh(), chosen);
  std::int64_t done = 0;
  NewVertex to;
  for (std::size_t v = 0; v < chosen.size(); ++v) {
    if (!chosen[v]) continue;
    balls.get(VertexId(v), s.context.ball);
    if (!f(VertexId(v), to)) continue;
    s.editor.move(VertexId(v), to, s.context.ball.tets, s.context.qualities);
    ++done;
  }
  return done;
}

}  // namespace

std::int64_t move_pass(PartState& s) {
  const std::int64_t done = move_chosen(s, take_asked(s), [&](VertexId v, NewVertex& to) {
    return s.count(Operator::kRelocate, relocate_in_ball(s.context, v, to));
  });
  s.result.changes += done;
  return done;
}

std::int64_t shake_pass(PartState& s) {
  const double below = s.settings.shake_below;
  return move_chosen(s, in_poor_balls(s.mesh(), below), [&](VertexId v, NewVertex& to) {
    return shake(s.context, v, below, kShakenFloor, to) == Verdict::kAccept;
  });
}

}  // namespace cavea
