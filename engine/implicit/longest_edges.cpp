#include "cavea/implicit/longest_edges.h"

#include <algorithm>
#include <tuple>

#include "cavea/base/atomic.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/local.h"

namespace cavea {
namespace {

class Choice {
 public:
  Choice(const TetMesh& mesh, std::vector<char> wanted)
      : mesh_(mesh),
        wanted_(std::move(wanted)),
        in_the_way_(mesh.tets.size(), 0),
        first_(mesh.tets.size(), 0) {
    bisection_.of_tet.assign(mesh.tets.size(), 0);
  }

  Bisection run() {
    std::vector<TetId> asked = ids_of(wanted_);
    while (!asked.empty()) asked = ask(asked);
    for (const TetId t : ids_of(first_)) bisection_.edges.push_back(edge_of(t));
    parallel_sort(bisection_.edges.begin(), bisection_.edges.end());
    return std::move(bisection_);
  }

 private:
  static std::vector<TetId> ids_of(const std::vector<char>& marked) {
    std::vector<TetId> ids;
    for (std::size_t t = 0; t < marked.size(); ++t)
      if (marked[t]) ids.push_back(TetId(t));
    return ids;
  }

  std::pair<VertexId, VertexId> edge_of(TetId t) const {
    const auto& e = kEdgeVertices[longest_edge(mesh_, t)];
    return std::minmax(mesh_.tets[t][e[0]], mesh_.tets[t][e[1]]);
  }

  /// \returns the tets that are in the way of those asked, and were not wanted before.
  std::vector<TetId> ask(const std::vector<TetId>& asked) {
    parallel_ranges(asked.size(), 256, [&](std::size_t begin, std::size_t end) {
      Shell shell;
      for (std::size_t i = begin; i < end; ++i) ask(asked[i], shell);
    });
    std::vector<TetId> next;
    for (const TetId t : ids_of(in_the_way_))
      if (!std::exchange(wanted_[t], 1)) next.push_back(t);
    return next;
  }

  void ask(TetId t, Shell& shell) {
    const auto& e = kEdgeVertices[longest_edge(mesh_, t)];
    gather_shell(mesh_, t, e[0], e[1], shell);
    if (is_required(shell)) return;
    const auto edge = edge_of(t);
    bool longest_of_all = true;
    for (const TetId other : shell.tets) {
      if (edge_of(other) == edge) continue;
      longest_of_all = false;
      atomic_or(in_the_way_[other], char{1});
    }
    if (!longest_of_all) return;
    for (const TetId other : shell.tets) atomic_or(bisection_.of_tet[other], char{1});
    atomic_or(first_[*std::ranges::min_element(shell.tets)], char{1});
  }

  bool is_required(const Shell& shell) const {
    // Of the tets at an edge in which the volume touches itself, the shell has only some.
    constexpr Tag kStays = tag::kOnRequiredEdge | tag::kPinched;
    if (mesh_.vertex_tags[shell.p] & mesh_.vertex_tags[shell.q] & kStays) return true;
    if (std::ranges::any_of(
            shell.tets, [&](TetId t) { return (mesh_.tet_flags[t] & tet_flag::kRequired) != 0; }))
      return true;
    return std::ranges::any_of(shell.triangles, [&](const Shell::At& at) {
      const Triangle& s = mesh_.triangles[at.triangle];
      Tag tags = s.tags;
      for (int k = 0; k < 3; ++k)
        if (s.v[k] != shell.p && s.v[k] != shell.q) tags |= s.edge_tag[k];
      return (tags & tag::kRequired) != 0;
    });
  }

  const TetMesh& mesh_;
  std::vector<char> wanted_;
  std::vector<char> in_the_way_;  ///< of another tet's bisection
  std::vector<char> first_;       ///< by tet: the first one at an edge of the set
  Bisection bisection_;
};

}  // namespace

int longest_edge(const TetMesh& mesh, TetId t) {
  const auto& v = mesh.tets[t];
  const auto key = [&](int e) {
    const auto [a, b] = std::minmax(v[kEdgeVertices[e][0]], v[kEdgeVertices[e][1]]);
    return std::tuple(distance2(mesh.points[a], mesh.points[b]), a, b);
  };
  int longest = 0;
  for (int e = 1; e < 6; ++e)
    if (key(longest) < key(e)) longest = e;
  return longest;
}

Bisection choose_longest_edges(const TetMesh& mesh, std::vector<char> wanted) {
  return Choice(mesh, std::move(wanted)).run();
}

}  // namespace cavea
