#pragma once
// Edges with closed shells of tets around them, as lists.
#include <cmath>
#include <numbers>

#include "cavea/geometry/predicates.h"
#include "support/meshes.h"

namespace cavea::test {

/// An edge with a closed shell of n tets: p is vertex 0, q is vertex 1, then the ring. Empty if the
/// random places make a tet that is not positive.
inline MeshData random_shell(int n, Random& random) {
  MeshData data;
  const double half = random.between(0.3, 1.5);
  data.vertices = {{random.between(-0.3, 0.3), random.between(-0.3, 0.3), -half},
                   {random.between(-0.3, 0.3), random.between(-0.3, 0.3), half}};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.between(-0.3, 0.3)) / n;
    const double radius = random.between(0.5, 1.2);
    data.vertices.push_back(
        {radius * std::cos(angle), radius * std::sin(angle), random.between(-0.2, 0.2)});
    data.tets.push_back({0, 1, 2 + i, 2 + (i + 1) % n});
  }
  for (const auto& t : data.tets)
    if (!certainly_positive(data.vertices[t[0]], data.vertices[t[1]], data.vertices[t[2]],
                            data.vertices[t[3]]))
      return {};
  data.vertex_refs.assign(data.vertices.size(), 0);
  data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

}  // namespace cavea::test
