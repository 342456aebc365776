#include "cavea/operator/starred_hole.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "cavea/base/keep_once.h"

namespace cavea {
StarredHole::StarredHole(const TetMesh& mesh, std::vector<TetId> tets,
                         std::span<const TriangleId> gone, const Vec3& place)
    : mesh_(mesh), tets_(std::move(tets)), gone_(gone), place_(place) {
  keep_once(tets_);
  find_hull();
}

bool StarredHole::goes(FaceLink link) const {
  return link.is_triangle() && std::ranges::binary_search(gone_, link.triangle());
}

void StarredHole::find_hull() {
  for (const TetId t : tets_)
    for (int f = 0; f < 4; ++f) {
      const FaceLink link = mesh_.links[t][f], behind = mesh_.across(t, f);
      if (behind.is_tet() && std::ranges::binary_search(tets_, behind.tet())) {
        is_whole_ &= !link.is_triangle() || goes(link);
        continue;
      }
      add_edges(t, f);
      if (goes(link))
        is_whole_ &= !behind.is_tet();
      else
        faces_.push_back({t, f});
    }
}

void StarredHole::add_edges(TetId t, int face) {
  const auto& v = mesh_.tets[t];
  for (int k = 0; k < 3; ++k) {
    const auto [a, b] = std::minmax(v[kFaceVertices[face][k]], v[kFaceVertices[face][(k + 1) % 3]]);
    edges_.push_back({a, b});
  }
}

std::vector<NewTet> StarredHole::star(VertexId apex) const {
  std::vector<NewTet> star;
  for (const Face& f : faces_) {
    NewTet n{mesh_.tets[f.tet], mesh_.tet_refs[f.tet]};
    std::array<Vec3, 4> x = mesh_.corners(f.tet);
    n.v[std::size_t(f.face)] = apex, x[std::size_t(f.face)] = place_;
    n.quality = float(tet_quality(x[0], x[1], x[2], x[3]));
    star.push_back(n);
  }
  return star;
}

std::optional<std::vector<VertexId>> StarredHole::vertices_inside() const {
  std::vector<std::array<VertexId, 2>> edges = edges_;
  keep_once(edges);
  std::vector<VertexId> hull, all, inside;
  for (const auto& e : edges) hull.insert(hull.end(), e.begin(), e.end());
  for (const TetId t : tets_) all.insert(all.end(), mesh_.tets[t].begin(), mesh_.tets[t].end());
  keep_once(hull);
  keep_once(all);
  // Each edge has two faces, and these three edges each.
  const std::size_t faces = edges_.size() / 3;
  if (2 * edges.size() != edges_.size() || hull.size() + faces != edges.size() + 2) return {};
  std::ranges::set_difference(all, hull, std::back_inserter(inside));
  return inside;
}

}  // namespace cavea
