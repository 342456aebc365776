#include "cavea/subdivide/contract.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>
#include <utility>

#include "cavea/base/atomic.h"
#include "cavea/base/buckets.h"
#include "cavea/base/cancel.h"
#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/base/scatter.h"
#include "cavea/geometry/metric.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/edge_shares.h"
#include "cavea/mesh/local.h"
#include "cavea/mesh/renumber.h"

namespace cavea {
namespace {

using Corners = std::array<VertexId, 4>;

/// Neighbours need different ranks, and no order along the numbering of the mesh.
std::uint64_t rank_of(VertexId v) { return scatter(kScatterStart + std::uint64_t(v)); }

bool is_degenerate(const Corners& k) {
  return k[0] == k[1] || k[0] == k[2] || k[0] == k[3] || k[1] == k[2] || k[1] == k[3] ||
         k[2] == k[3];
}

class Contraction {
 public:
  Contraction(const TetMesh& mesh, const ContractionLimits& limits, const std::atomic<bool>* cancel)
      : mesh_(mesh), limits_(limits), cancel_(cancel), near_(short_edges()) {}

  std::optional<TetMesh> operator()() {
    throw_if_cancelled(cancel_);
    choose_kept();
    choose_images();
    if (!is_worthwhile()) return std::nullopt;
    for (auto changed = give_way_anywhere(); !changed.empty(); changed = give_way_around(changed))
      throw_if_cancelled(cancel_);
    // Who asks again until nothing is left to gain is to come to an end.
    if (!is_worthwhile()) return std::nullopt;
    return make();
  }

 private:
  enum class State : std::uint8_t { kOpen, kStays, kGoes };
  static constexpr std::size_t kBalls = 64;  ///< a task: each is some twenty tets

  /// Inside the volume and not required: what has no tag but those of parts.
  bool may_go(VertexId v) const {
    return mesh_.vertex_alive(v) && tag::is_unbound(mesh_.vertex_tags[v]);
  }

  /// By vertex, the other ends of its short edges, some of them more than once.
  Buckets short_edges() const {
    // A bit for each edge of a tet: buckets ask for all that is put into them twice.
    std::vector<std::uint8_t> is_short(mesh_.tets.size());
    parallel_for(is_short.size(), [&](std::size_t t) {
      if (mesh_.tet_alive(TetId(t))) is_short[t] = short_edges_of(TetId(t));
    });
    return Buckets(mesh_.tets.size(), mesh_.points.size(), [&](std::size_t t, auto&& put) {
      for (unsigned left = is_short[t]; left != 0; left &= left - 1) {
        const auto& e = kEdgeVertices[std::countr_zero(left)];
        const VertexId a = mesh_.tets[t][e[0]], b = mesh_.tets[t][e[1]];
        put(a, std::uint32_t(b));
        put(b, std::uint32_t(a));
      }
    });
  }

  std::uint8_t short_edges_of(TetId t) const {
    unsigned edges = 0;
    EdgeShare(mesh_, t).for_each([&](const auto& e) {
      const VertexId a = mesh_.tets[t][e[0]], b = mesh_.tets[t][e[1]];
      if (may_go(a) && may_go(b) && !is_longer(a, b, limits_.short_edge))
        edges |= 1u << (&e - kEdgeVertices);
    });
    return std::uint8_t(edges);
  }

  bool is_longer(VertexId a, VertexId b, double limit) const {
    return length_exceeds(distance2(mesh_.points[a], mesh_.points[b]), mesh_.sizes[a],
                          mesh_.sizes[b], limit);
  }

  /// All at once, over and over: who is beside one that stays goes, who has the lowest rank of
  /// those that are left beside it stays.
  void choose_kept() {
    state_.resize(mesh_.points.size());
    std::vector<State> next(state_.size());
    const auto decide = [&](VertexId v) {
      bool lowest = true;
      for (const std::uint32_t w : near_.of(std::size_t(v))) {
        if (state_[w] == State::kStays) return State::kGoes;
        lowest = lowest && (state_[w] == State::kGoes || rank_of(v) < rank_of(VertexId(w)));
      }
      return lowest ? State::kStays : State::kOpen;
    };
    for (bool open = true; open; std::swap(state_, next))
      open = any_vertex([&](std::size_t v) {
        next[v] = state_[v] == State::kOpen ? decide(VertexId(v)) : state_[v];
        return next[v] == State::kOpen;
      });
  }

  void choose_images() {
    image_.resize(mesh_.points.size());
    gives_way_.resize(image_.size());
    parallel_for(image_.size(), [&](std::size_t v) {
      image_[v] = state_[v] == State::kGoes ? next_image(VertexId(v), {-1, kNone}) : VertexId(v);
    });
  }

  /// Whether so many vertices go.
  bool is_worthwhile() const {
    const auto going = parallel_reduce(
        image_.size(), std::size_t{0},
        [&](std::size_t begin, std::size_t end) {
          std::size_t moved = 0;
          for (std::size_t v = begin; v < end; ++v) moved += image_[v] != VertexId(v);
          return moved;
        },
        std::plus<>{});
    return double(going) >= limits_.worthwhile * double(image_.size());
  }

  using Candidate = std::pair<double, VertexId>;  ///< the square of its distance comes first

  /// The next one beside v that stays, after `last`; v itself if that was the farthest.
  VertexId next_image(VertexId v, const Candidate& last) const {
    Candidate best{std::numeric_limits<double>::infinity(), v};
    for (const std::uint32_t w : near_.of(std::size_t(v))) {
      if (state_[w] != State::kStays) continue;
      const Candidate c{distance2(mesh_.points[v], mesh_.points[w]), VertexId(w)};
      if (last < c && c < best) best = c;
    }
    return best.second;
  }

  Corners images(const Corners& k) const {
    return {image_[k[0]], image_[k[1]], image_[k[2]], image_[k[3]]};
  }

  bool is_sound(const Corners& k) const {
    const auto& p = mesh_.points;
    return quality_exceeds(p[k[0]], p[k[1]], p[k[2]], p[k[3]], limits_.least_quality) &&
           std::ranges::none_of(kEdgeVertices, [&](const auto& e) {
             return is_longer(k[e[0]], k[e[1]], limits_.long_edge);
           });
  }

  /// Where a tet is not sound, one of its vertices gives way. \return those that have
  std::vector<VertexId> give_way_anywhere() {
    parallel_for(mesh_.tets.size(), [&](std::size_t t) {
      if (mesh_.tet_alive(TetId(t))) look_at(TetId(t));
    });
    return take_next_images();
  }

  /// The same of the tets at vertices inside that have changed.
  std::vector<VertexId> give_way_around(const std::vector<VertexId>& changed) {
    parallel_for(
        changed.size(),
        [&](std::size_t i) {
          std::vector<TetId> ball;
          small_ball(mesh_, changed[i], ball);
          for (const TetId t : ball) look_at(t);
        },
        kBalls);
    return take_next_images();
  }

  void look_at(TetId t) {
    const Corners &k = mesh_.tets[t], to = images(k);
    if (to == k || is_degenerate(to) || is_sound(to)) return;
    VertexId first = kNone;
    for (const VertexId v : k)
      if (image_[v] != v && (first == kNone || rank_of(v) < rank_of(first))) first = v;
    atomic_or(gives_way_[first], std::uint8_t{1});
  }

  std::vector<VertexId> take_next_images() {
    std::vector<VertexId> given =
        ids_where(image_.size(), [&](VertexId v) { return gives_way_[v] != 0; });
    parallel_for(given.size(), [&](std::size_t i) {
      const VertexId v = given[i];
      gives_way_[v] = 0;
      image_[v] = next_image(v, {distance2(mesh_.points[v], mesh_.points[image_[v]]), image_[v]});
    });
    return given;
  }

  /// Whether f(v) is true for any vertex; it is called for all.
  template <class F>
  bool any_vertex(F&& f) const {
    return parallel_reduce(
        mesh_.points.size(), false,
        [&](std::size_t begin, std::size_t end) {
          bool any = false;
          for (std::size_t v = begin; v < end; ++v) any = f(v) || any;
          return any;
        },
        std::logical_or<>{});
  }

  TetMesh make() const {
    const Renumbering vertices(mesh_.points.size(), [&](std::size_t v) {
      return mesh_.vertex_alive(VertexId(v)) && image_[v] == VertexId(v);
    });
    TetMesh out;
    out.points = vertices.kept_of(mesh_.points);
    out.sizes = vertices.kept_of(mesh_.sizes);
    out.vertex_tags = vertices.kept_of(mesh_.vertex_tags);
    out.vertex_refs = vertices.kept_of(mesh_.vertex_refs);
    out.anchors = vertices.kept_of(mesh_.anchors);
    make_tets(vertices, out);
    out.triangles = living_triangles(mesh_).kept_of(mesh_.triangles);
    for (Triangle& s : out.triangles)
      for (VertexId& v : s.v) v = vertices[v];
    out.normals = mesh_.normals;
    for (GivenNormal& given : out.normals) given.vertex = vertices[given.vertex];
    link_faces(out);
    attach_triangles(out);
    return out;
  }

  void make_tets(const Renumbering& vertices, TetMesh& out) const {
    const Renumbering tets(mesh_.tets.size(), [&](std::size_t t) {
      return mesh_.tet_alive(TetId(t)) && !is_degenerate(images(mesh_.tets[t]));
    });
    out.resize_tets(tets.count);
    parallel_for(mesh_.tets.size(), [&](std::size_t t) {
      const TetId to = tets[TetId(t)];
      if (to == kNone) return;
      const Corners image = images(mesh_.tets[t]);
      for (std::size_t i = 0; i < 4; ++i) out.tets[to][i] = vertices[image[i]];
      const std::uint8_t asks = image == mesh_.tets[t] ? std::uint8_t{0} : tet_flag::kAskAll;
      out.tet_flags[to] = mesh_.tet_flags[t] | asks;
      out.tet_refs[to] = mesh_.tet_refs[t];
    });
  }

  const TetMesh& mesh_;
  const ContractionLimits& limits_;
  const std::atomic<bool>* cancel_;
  const Buckets near_;
  std::vector<State> state_;
  std::vector<VertexId> image_;          ///< where each vertex goes
  std::vector<std::uint8_t> gives_way_;  ///< those whose images are to change
};

}  // namespace

std::optional<TetMesh> contracted(const TetMesh& mesh, const ContractionLimits& limits,
                                  const std::atomic<bool>* cancel) {
  return Contraction(mesh, limits, cancel)();
}

}  // namespace cavea
