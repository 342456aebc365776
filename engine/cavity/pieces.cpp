#include "cavea/cavity/pieces.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

namespace cavea {
namespace {

using Corners = std::array<VertexId, 4>;

/// Whether two tets at a vertex have a face there.
bool share_face(const Corners& a, const Corners& b) {
  return std::ranges::count_if(a, [&](VertexId v) { return std::ranges::find(b, v) != b.end(); }) ==
         3;
}

/// How many pieces the tets at v are. Those of a cavity are few.
std::size_t pieces_at(VertexId v, const std::vector<Corners>& tets) {
  std::vector<Corners> left, piece;
  std::ranges::copy_if(tets, std::back_inserter(left),
                       [&](const Corners& t) { return std::ranges::find(t, v) != t.end(); });
  std::size_t pieces = 0;
  for (; !left.empty(); ++pieces) {
    piece.assign(1, left.back());
    left.pop_back();
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Corners at = piece[i];  // the piece grows
      const auto beside =
          std::ranges::partition(left, [&](const Corners& t) { return !share_face(at, t); });
      piece.insert(piece.end(), beside.begin(), beside.end());
      left.erase(beside.begin(), beside.end());
    }
  }
  return pieces;
}

}  // namespace

bool keeps_balls(const TetMesh& mesh, const Cavity& cavity) {
  std::vector<Corners> before, after;
  for (const TetId t : cavity.removed_tets) before.push_back(mesh.tets[t]);
  for (const NewTet& n : cavity.tets) after.push_back(n.v);
  std::vector<VertexId> vertices;
  for (const Corners& t : before)
    for (const VertexId v : t)
      if (mesh.vertex_tags[v] & tag::kSurface) vertices.push_back(v);
  std::ranges::sort(vertices);
  vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
  return std::ranges::all_of(
      vertices, [&](VertexId v) { return pieces_at(v, before) == pieces_at(v, after); });
}

}  // namespace cavea
