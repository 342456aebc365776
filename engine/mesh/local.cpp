#include "cavea/mesh/local.h"

#include <algorithm>

#include "cavea/base/error.h"

namespace cavea {

void gather_ball(const TetMesh& mesh, VertexId v, TetMarker& marker, Ball& ball) {
  ball.v = v;
  ball.cut = false;
  ball.tets.clear();
  marker.begin(mesh.tets.size());
  const TetId first = mesh.vertex_tets[v];
  // Where a surface passes through itself, positive volumes do not prove that a mesh stays whole.
  if (first == kNone) throw InternalError("a vertex of a tetrahedron has been removed");
  marker.mark(first);
  ball.tets.push_back(first);
  for (std::size_t i = 0; i < ball.tets.size(); ++i) {
    const TetId t = ball.tets[i];
    const auto& k = mesh.tets[t];
    for (int f = 0; f < 4; ++f) {
      if (k[f] == v) continue;
      const FaceLink n = mesh.across(t, f);
      if (n.is_tet()) {
        if (marker.mark(n.tet())) ball.tets.push_back(n.tet());
      } else if (n.is_cut()) {
        ball.cut = true;
      }
    }
  }
}

bool has_vertex(const TetMesh& mesh, const Ball& ball, VertexId v) {
  return std::ranges::any_of(ball.tets, [&](TetId t) { return mesh.local_index(t, v) < 4; });
}

bool has_on_triangle(const TetMesh& mesh, const Ball& ball, VertexId v) {
  bool found = false;
  for_each_triangle(mesh, ball, [&](TriangleId id) {
    found |= std::ranges::find(mesh.triangles[id].v, v) != mesh.triangles[id].v.end();
  });
  return found;
}

void small_ball(const TetMesh& mesh, VertexId v, std::vector<TetId>& ball) {
  // The first ones, mostly all, are in a table; the others are looked for one by one.
  constexpr std::size_t kTabled = 128;
  std::array<TetId, 2 * kTabled> table;
  table.fill(kNone);
  const auto is_new = [&](TetId t) {
    std::size_t k = std::size_t(t) % table.size();
    while (table[k] != t && table[k] != kNone) k = (k + 1) % table.size();
    if (table[k] == t) return false;
    if (ball.size() >= kTabled)
      return std::find(ball.begin() + kTabled, ball.end(), t) == ball.end();
    table[k] = t;
    return true;
  };
  ball.clear();
  is_new(mesh.vertex_tets[v]);
  ball.push_back(mesh.vertex_tets[v]);
  for (std::size_t i = 0; i < ball.size(); ++i)
    for (int f = 0; f < 4; ++f) {
      if (mesh.tets[ball[i]][f] == v) continue;
      const FaceLink next = mesh.across(ball[i], f);
      if (next.is_tet() && is_new(next.tet())) ball.push_back(next.tet());
    }
}

namespace {

/// The two other local vertices of an edge (i, j) so that (i, j, third, fourth) is even.
void other_two(int i, int j, int& third, int& fourth) {
  static constexpr int kThird[4][4] = {{-1, 2, 3, 1}, {3, -1, 0, 2}, {1, 3, -1, 0}, {2, 0, 1, -1}};
  third = kThird[i][j];
  fourth = 6 - i - j - third;
}

}  // namespace

void gather_shell(const TetMesh& mesh, TetId start, int i, int j, Shell& shell) {
  shell.p = mesh.tets[start][i];
  shell.q = mesh.tets[start][j];
  shell.tets.clear();
  shell.ring.clear();
  shell.triangles.clear();
  shell.closed = shell.cut = false;
  int r, s;
  other_two(i, j, r, s);
  const VertexId ring0 = mesh.tets[start][r], ring1 = mesh.tets[start][s];
  shell.tets.push_back(start);
  shell.ring.push_back(ring0);
  shell.ring.push_back(ring1);

  // Forward: leave each tet through the face that holds p, q and its newest ring vertex.
  TetId t = start;
  int leave = r;
  for (;;) {
    const FaceLink link = mesh.links[t][leave];
    const int at = int(shell.ring.size()) - 1;
    FaceLink next = link;
    if (link.is_triangle()) {
      next = mesh.across(t, leave);
      shell.triangles.push_back({link.triangle(), at});
    }
    if (!next.is_tet()) {
      shell.cut |= next.is_cut();
      break;
    }
    if (next.tet() == start) {
      shell.closed = true;
      shell.ring.pop_back();
      for (auto& x : shell.triangles)
        if (x.ring == at) x.ring = 0;
      return;
    }
    const VertexId pivot = shell.ring.back();
    t = next.tet();
    shell.ring.push_back(mesh.tets[t][next.face()]);
    shell.tets.push_back(t);
    leave = mesh.local_index(t, pivot);
  }

  // Open: backwards from the start, then put in front.
  std::size_t forward_tets = shell.tets.size(), forward_ring = shell.ring.size(),
              forward_triangles = shell.triangles.size();
  t = start;
  leave = s;
  VertexId pivot = ring0;
  for (;;) {
    const FaceLink link = mesh.links[t][leave];
    const int back = int(shell.ring.size() - forward_ring);
    FaceLink next = link;
    if (link.is_triangle()) {
      next = mesh.across(t, leave);
      shell.triangles.push_back({link.triangle(), -back});
    }
    if (!next.is_tet()) {
      shell.cut |= next.is_cut();
      break;
    }
    t = next.tet();
    leave = mesh.local_index(t, pivot);
    pivot = mesh.tets[t][next.face()];
    shell.ring.push_back(pivot);
    shell.tets.push_back(t);
  }
  const int shift = int(shell.ring.size() - forward_ring);
  std::reverse(shell.tets.begin() + std::ptrdiff_t(forward_tets), shell.tets.end());
  std::rotate(shell.tets.begin(), shell.tets.begin() + std::ptrdiff_t(forward_tets),
              shell.tets.end());
  std::reverse(shell.ring.begin() + std::ptrdiff_t(forward_ring), shell.ring.end());
  std::rotate(shell.ring.begin(), shell.ring.begin() + std::ptrdiff_t(forward_ring),
              shell.ring.end());
  for (auto& x : shell.triangles) x.ring += shift;
  std::rotate(shell.triangles.begin(), shell.triangles.begin() + std::ptrdiff_t(forward_triangles),
              shell.triangles.end());
}

}  // namespace cavea
