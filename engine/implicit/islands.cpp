#include "cavea/implicit/islands.h"

#include "cavea/base/parallel.h"
#include "cavea/mesh/union_find.h"

namespace cavea {

std::int64_t turn_islands(const TetMesh& mesh, std::int8_t side, double least, bool closed_only,
                          std::vector<std::int8_t>& sides) {
  const std::size_t n = mesh.tets.size();
  UnionFind components(n);
  std::vector<char> spared(n, 0);
  parallel_for(n, [&](std::size_t t) {
    for (int f = 0; f < 4 && sides[t] == side; ++f) {
      const FaceLink next = mesh.across(TetId(t), f);
      if (next.is_tet() && sides[next.tet()] == side)
        components.join(std::int32_t(t), next.tet());
      else if (next.is_unset() && closed_only)
        spared[t] = 1;
    }
  });
  std::vector<double> volume(n, 0);
  // In order of the tets: sums must not depend on the threads.
  for (std::size_t t = 0; t < n; ++t) {
    if (sides[t] != side) continue;
    const auto root = std::size_t(components.root(std::int32_t(t)));
    const auto [a, b, c, d] = mesh.corners(TetId(t));
    volume[root] += volume6(a, b, c, d) / 6;
    spared[root] |= spared[t];
  }
  std::int64_t turned = 0;
  for (std::size_t t = 0; t < n; ++t) {
    if (sides[t] != side) continue;
    const auto root = std::size_t(components.root(std::int32_t(t)));
    if (spared[root] || volume[root] >= least) continue;
    turned += root == t;
    sides[t] = std::int8_t(-side);  // the root is its component's first tet: nobody asks it twice
  }
  return turned;
}

}  // namespace cavea
