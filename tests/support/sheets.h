#pragma once
// Triangles inside the volume, for the tests.
#include <map>

#include "support/meshes.h"

namespace cavea::test {

inline constexpr std::int32_t kSheetRef = 9;

/// Lists the faces between two tets of one reference for which keep(a, b, c) holds, with
/// kSheetRef; as they come, so that they face any way.
template <class Keep>
void add_sheet(MeshData& data, Keep&& keep) {
  std::map<std::array<std::int32_t, 3>, std::int32_t> first_tet;
  for (std::size_t t = 0; t < data.tets.size(); ++t)
    for (int k = 0; k < 4; ++k) {
      std::array<std::int32_t, 3> v{};
      for (int i = 0; i < 3; ++i) v[std::size_t(i)] = data.tets[t][std::size_t((k + 1 + i) % 4)];
      std::array<std::int32_t, 3> key = v;
      std::sort(key.begin(), key.end());
      const auto [at, is_new] = first_tet.try_emplace(key, std::int32_t(t));
      if (is_new || data.tet_refs[std::size_t(at->second)] != data.tet_refs[t]) continue;
      if (!keep(data.vertices[v[0]], data.vertices[v[1]], data.vertices[v[2]])) continue;
      data.triangles.push_back(v);
      data.triangle_refs.push_back(kSheetRef);
    }
}

/// A sheet in the plane x = 0.5, where within(y, z) holds at the triangles' centroids.
template <class Within>
void add_plane_sheet(MeshData& data, Within&& within) {
  add_sheet(data, [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 m = (a + b + c) / 3;
    return a.x == 0.5 && b.x == 0.5 && c.x == 0.5 && within(m.y, m.z);
  });
}

}  // namespace cavea::test
