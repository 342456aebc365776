#include "cavea/implicit/bisect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "cavea/base/atomic.h"
#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/subdivide/subdivide.h"

namespace cavea {
namespace {

/// A tet to be halved, as it was: the half with the smaller end of the edge takes its id.
struct Halving {
  TetId tet = kNone;
  std::int32_t edge = 0;      ///< its rank in the set
  std::array<int, 2> end{};   ///< the edge's ends in the tet, the smaller vertex first
  std::array<int, 2> face{};  ///< the faces that are halved: opposite the other two vertices
  std::array<FaceLink, 4> links{};
  std::array<int, 4> side{};  ///< by face with a triangle: which of the triangle's it is
  bool names_second = false;  ///< it is the tet that the second end knows
};

class Bisecting {
 public:
  Bisecting(TetMesh& mesh, const Bisection& bisection)
      : mesh_(mesh),
        edges_(bisection.edges),
        first_vertex_(VertexId(mesh.points.size())),
        first_tet_(TetId(mesh.tets.size())) {
    std::vector<TetId> tets;
    for (std::size_t t = 0; t < bisection.of_tet.size(); ++t)
      if (bisection.of_tet[t]) tets.push_back(TetId(t));
    halvings_.resize(tets.size());
    if (const auto total = std::int64_t(mesh.tets.size() + tets.size()); total > kMaxTets)
      throw InputError(
          fmt::format("bisection makes {} tets; at most {} can be held", total, kMaxTets));
    halving_of_.assign(mesh.tets.size(), kNone);
    parallel_for(tets.size(), [&](std::size_t h) {
      halvings_[h] = describe(tets[h]);
      halving_of_[tets[h]] = std::int32_t(h);
    });
  }

  void run() {
    number_triangles();
    make_vertices();
    mesh_.resize_tets(first_tet_ + halvings_.size());
    parallel_for(halvings_.size(), [&](std::size_t h) {
      halve_tet(halvings_[h], TetId(first_tet_ + h));
      for (const int f : halvings_[h].face) halve_triangle_at(halvings_[h], f);
    });
    parallel_for(halvings_.size(), [&](std::size_t h) {
      for (const TetId t : {halvings_[h].tet, TetId(first_tet_ + h)})
        mesh_.qualities[t] = float(mesh_.compute_quality(t));
    });
  }

 private:
  Halving describe(TetId t) const {
    Halving h;
    h.tet = t;
    const auto& e = kEdgeVertices[longest_edge(mesh_, t)];
    const auto& v = mesh_.tets[t];
    h.end = {e[0], e[1]};
    if (v[h.end[0]] > v[h.end[1]]) std::swap(h.end[0], h.end[1]);
    h.face = {e[2], e[3]};
    const std::pair edge(v[h.end[0]], v[h.end[1]]);
    h.edge = std::int32_t(std::ranges::lower_bound(edges_, edge) - edges_.begin());
    h.links = mesh_.links[t];
    for (int f = 0; f < 4; ++f)
      if (h.links[f].is_triangle()) {
        const Triangle& s = mesh_.triangles[h.links[f].triangle()];
        h.side[f] = s.sides[0] == FaceLink::to_tet(t, f) ? 0 : 1;
      }
    h.names_second = mesh_.vertex_tets[edge.second] == t;
    return h;
  }

  /// Whether face f is halved together with a triangle, of which this is the first side.
  static bool halves_triangle(const Halving& h, int f) {
    return h.links[f].is_triangle() && h.side[f] == 0;
  }

  /// Gives the second halves of triangles their ids.
  void number_triangles() {
    std::vector<TriangleId> first(halvings_.size());
    parallel_for(first.size(), [&](std::size_t k) {
      const Halving& h = halvings_[k];
      first[k] = halves_triangle(h, h.face[0]) + halves_triangle(h, h.face[1]);
    });
    const std::size_t before = mesh_.triangles.size();
    const TriangleId more = exclusive_scan(first);
    second_of_.assign(before, kNone);
    parallel_for(first.size(), [&](std::size_t k) {
      TriangleId next = TriangleId(before) + first[k];
      for (const int f : halvings_[k].face)
        if (halves_triangle(halvings_[k], f)) second_of_[halvings_[k].links[f].triangle()] = next++;
    });
    mesh_.triangles.resize(before + more);
  }

  void make_vertices() {
    constexpr std::int32_t kNothing = std::numeric_limits<std::int32_t>::max();
    std::vector<TriangleId> triangle(edges_.size(), kNothing);
    std::vector<TetId> tet(edges_.size(), kNothing);
    parallel_for(halvings_.size(), [&](std::size_t k) {
      const Halving& h = halvings_[k];
      atomic_min(tet[h.edge], h.tet);
      for (const int f : h.face)
        if (h.links[f].is_triangle()) atomic_min(triangle[h.edge], h.links[f].triangle());
    });
    mesh_.resize_vertices(first_vertex_ + edges_.size());
    parallel_for(edges_.size(), [&](std::size_t k) {
      MeshEdge edge{edges_[k].first, edges_[k].second};
      if (triangle[k] != kNothing) {
        edge.triangle = triangle[k];
        const auto& v = mesh_.triangles[triangle[k]].v;
        while (v[edge.side] == edge.a || v[edge.side] == edge.b) ++edge.side;
      }
      set_vertex(VertexId(first_vertex_ + k), straight_midpoint(mesh_, edge));
      mesh_.vertex_tets[first_vertex_ + k] = tet[k];
    });
  }

  void set_vertex(VertexId v, const NewVertex& made) {
    mesh_.points[v] = made.point;
    mesh_.sizes[v] = made.size;
    mesh_.vertex_tags[v] = made.tags;
    mesh_.vertex_refs[v] = made.ref;
    mesh_.anchors[v] = made.anchor;
  }

  void halve_tet(const Halving& h, TetId second) {
    const auto [a, b] = h.end;
    const VertexId middle = first_vertex_ + h.edge;
    if (h.names_second) mesh_.vertex_tets[mesh_.tets[h.tet][b]] = second;
    mesh_.tets[second] = mesh_.tets[h.tet];
    mesh_.tets[second][a] = middle;
    mesh_.tets[h.tet][b] = middle;
    mesh_.tet_refs[second] = mesh_.tet_refs[h.tet];
    mesh_.tet_flags[h.tet] |= tet_flag::kAskAll;
    mesh_.tet_flags[second] = mesh_.tet_flags[h.tet];
    mesh_.links[h.tet][a] = FaceLink::to_tet(second, b);
    mesh_.links[second][b] = FaceLink::to_tet(h.tet, a);
    mesh_.links[h.tet][b] = behind_whole(h.links[b]);
    mesh_.links[second][a] = behind_whole(h.links[a]);
    for (const int f : h.face) mesh_.links[second][f] = behind_second_half(h.links[f]);
    tell_neighbour(h, second);
  }

  /// What was behind a face that is not halved. The neighbour's half there keeps the face's place.
  FaceLink behind_whole(FaceLink link) const {
    if (!link.is_tet()) return link;
    const std::int32_t k = halving_of_[link.tet()];
    if (k == kNone || link.face() != halvings_[k].end[0]) return link;
    return FaceLink::to_tet(first_tet_ + k, link.face());
  }

  /// What is behind the second half of a face, at which the neighbour is halved at the same edge.
  FaceLink behind_second_half(FaceLink link) const {
    if (link.is_triangle()) return FaceLink::to_triangle(second_of_[link.triangle()]);
    if (!link.is_tet()) return link;
    return FaceLink::to_tet(first_tet_ + halving_of_[link.tet()], link.face());
  }

  /// The face opposite the first end is now the second half's.
  void tell_neighbour(const Halving& h, TetId second) {
    const int a = h.end[0];
    const FaceLink link = h.links[a], here = FaceLink::to_tet(second, a);
    if (link.is_triangle()) mesh_.triangles[link.triangle()].sides[h.side[a]] = here;
    if (link.is_tet() && halving_of_[link.tet()] == kNone)
      mesh_.links[link.tet()][link.face()] = here;
  }

  void halve_triangle_at(const Halving& h, int f) {
    if (!halves_triangle(h, f)) return;
    Triangle& first = mesh_.triangles[h.links[f].triangle()];
    Triangle& second = mesh_.triangles[second_of_[h.links[f].triangle()]];
    second = first;
    const auto [a, b] = edges_[h.edge];
    for (int i = 0; i < 3; ++i) {
      if (first.v[i] != a && first.v[i] != b) continue;
      Triangle& without = first.v[i] == a ? second : first;
      Triangle& with = first.v[i] == a ? first : second;
      without.v[i] = first_vertex_ + h.edge;
      with.edge_tag[i] = 0;
      with.edge_ref[i] = 0;
    }
    for (FaceLink& side : second.sides) side = behind_second_half(side);
  }

  TetMesh& mesh_;
  const std::vector<std::pair<VertexId, VertexId>>& edges_;
  const VertexId first_vertex_;  ///< the one on the first edge
  const TetId first_tet_;        ///< the second half of the first one halved
  std::vector<Halving> halvings_;
  std::vector<std::int32_t> halving_of_;  ///< of each tet before; kNone
  std::vector<TriangleId> second_of_;     ///< of each triangle before; kNone if not halved
};

}  // namespace

void bisect(TetMesh& mesh, const Bisection& bisection) { Bisecting(mesh, bisection).run(); }

}  // namespace cavea
