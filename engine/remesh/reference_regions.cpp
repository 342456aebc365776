#include "cavea/remesh/reference_regions.h"

#include <algorithm>
#include <array>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

std::map<std::int32_t, std::vector<Corners>> by_reference(const TetMesh& mesh) {
  std::map<std::int32_t, std::vector<Corners>> out;
  for (const Triangle& t : mesh.triangles)
    if (t.alive())
      out[t.ref].push_back({mesh.points[t.v[0]], mesh.points[t.v[1]], mesh.points[t.v[2]]});
  return out;
}

Vec3 middle_of(const Corners& t) { return (t[0] + t[1] + t[2]) / 3; }

FailedPlace around(const Corners& t) {
  constexpr double kAround = 2;  // edges
  return {middle_of(t),
          kAround * std::max({distance(t[0], t[1]), distance(t[1], t[2]), distance(t[2], t[0])})};
}

}  // namespace

ReferenceRegions::ReferenceRegions(const TetMesh& mesh) : triangles_(by_reference(mesh)) {}

std::vector<FailedPlace> ReferenceRegions::lost_from(const TetMesh& mesh, double reach) const {
  std::vector<FailedPlace> lost;
  if (triangles_.size() < 2) return lost;  // one covers all
  const auto now = by_reference(mesh);
  for (const auto& [ref, triangles] : triangles_) {
    const auto at = now.find(ref);
    const FacetTree tree(at == now.end() ? std::span<const Corners>() : at->second);
    std::vector<char> is_lost(triangles.size());
    parallel_for(triangles.size(), [&](std::size_t t) {
      const auto& [a, b, c] = triangles[t];
      is_lost[t] = std::ranges::any_of(std::array{a, b, c, middle_of(triangles[t])}, [&](Vec3 p) {
        return tree.nearest(p, reach * reach).facet == kNone;
      });
    });
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (is_lost[t]) lost.push_back(around(triangles[t]));
  }
  return lost;
}

}  // namespace cavea
