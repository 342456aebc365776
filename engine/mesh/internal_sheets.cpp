#include "cavea/mesh/internal_sheets.h"

#include "cavea/mesh/surface_edges.h"

namespace cavea {
namespace {

void turn(Triangle& s) {
  std::swap(s.v[1], s.v[2]);
  std::swap(s.edge_tag[1], s.edge_tag[2]);
  std::swap(s.edge_ref[1], s.edge_ref[2]);
  std::swap(s.sides[0], s.sides[1]);
}

/// Whether two triangles run through their common edge in the same direction, as those that face
/// the same way never do.
bool disagree(const TetMesh& mesh, TriangleEdge a, TriangleEdge b) {
  const auto &va = mesh.triangles[a.triangle].v, &vb = mesh.triangles[b.triangle].v;
  return va[(a.local + 1) % 3] == vb[(b.local + 1) % 3];
}

}  // namespace

void orient_internal_sheets(TetMesh& mesh) {
  const SurfaceEdges edges(mesh);
  std::vector<char> seen(mesh.triangles.size(), 0);
  std::vector<TriangleId> queue;
  const auto visit = [&](TriangleId i) {
    seen[i] = 1;
    queue.push_back(i);
  };
  // Serial: sheets are few, and the first triangle of each says how it faces.
  for (std::size_t first = 0; first < mesh.triangles.size(); ++first) {
    if (seen[first] || !(mesh.triangles[first].tags & tag::kInternal)) continue;
    visit(TriangleId(first));
    while (!queue.empty()) {
      const TriangleId i = queue.back();
      queue.pop_back();
      for (int k = 0; k < 3; ++k) {
        const auto& v = mesh.triangles[i].v;
        const auto uses = edges.find(mesh, v[(k + 1) % 3], v[(k + 2) % 3]);
        if (uses.size() != 2) continue;
        TriangleEdge next = SurfaceEdges::decode(uses[0]);
        if (next.triangle == i) next = SurfaceEdges::decode(uses[1]);
        if (seen[next.triangle]) continue;
        if (disagree(mesh, {i, k}, next)) turn(mesh.triangles[next.triangle]);
        visit(next.triangle);
      }
    }
  }
}

}  // namespace cavea
