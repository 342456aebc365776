#pragma once
// Small meshes for the tests, as lists; build() makes a TetMesh of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "cavea/geometry/predicates.h"
#include "cavea/mesh/mesh_data.h"

namespace cavea::test {

/// The same numbers on every platform, unlike the standard's distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}
  /// Uniform in [0, 1).
  double unit() { return double(bits_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  /// Uniform in [0, n).
  std::int32_t below(std::int32_t n) { return std::int32_t(unit() * n); }

 private:
  std::mt19937_64 bits_;
};

/// 0 .. n-1 in a random order.
inline std::vector<std::int32_t> random_order(std::size_t n, Random& random) {
  std::vector<std::int32_t> order(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::int32_t j = random.below(std::int32_t(i) + 1);
    order[i] = order[j];
    order[j] = std::int32_t(i);
  }
  return order;
}

/// The regular tetrahedron of edge sqrt 2.
inline MeshData single_tet() {
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
  data.vertex_refs = {0, 0, 0, 0};
  data.tets = {{0, 1, 2, 3}};
  data.tet_refs = {1};
  return data;
}

/// Two tets on either side of the triangle of the unit vectors.
inline MeshData two_tets() {
  MeshData data;
  data.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  data.vertex_refs.assign(5, 0);
  data.tets = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  data.tet_refs = {1, 1};
  return data;
}

/// Adds a tet, turned so that its volume is positive.
inline void add_positive(MeshData& data, std::array<std::int32_t, 4> tet) {
  const auto& x = data.vertices;
  if (volume6(x[tet[0]], x[tet[1]], x[tet[2]], x[tet[3]]) < 0) std::swap(tet[0], tet[1]);
  data.tets.push_back(tet);
}

/// The cells of an n^3 grid of the unit cube for which keep(i, j, k) holds, six tets each around
/// the cell's main diagonal (Kuhn): conforming, of quality 0.657, and of reference 1.
template <class Keep>
MeshData kuhn_grid(int n, Keep&& keep) {
  MeshData data;
  std::vector<std::int32_t> number(std::size_t(n + 1) * std::size_t(n + 1) * std::size_t(n + 1),
                                   -1);
  const auto vertex = [&](const std::array<int, 3>& p) {
    std::int32_t& id = number[(std::size_t(p[2]) * (n + 1) + p[1]) * (n + 1) + p[0]];
    if (id < 0) {
      id = std::int32_t(data.vertices.size());
      data.vertices.push_back({double(p[0]) / n, double(p[1]) / n, double(p[2]) / n});
    }
    return id;
  };
  constexpr int kAxes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        if (!keep(i, j, k)) continue;
        for (int p = 0; p < 6; ++p) {
          std::array<int, 3> at = {i, j, k};
          std::array<std::int32_t, 4> tet{vertex(at)};
          for (int step = 0; step < 3; ++step) {
            ++at[kAxes[p][step]];
            tet[step + 1] = vertex(at);
          }
          if (p >= 3) std::swap(tet[2], tet[3]);  // odd permutation of the axes
          data.tets.push_back(tet);
        }
      }
  data.vertex_refs.assign(data.vertices.size(), 0);
  data.tet_refs.assign(data.tets.size(), 1);
  return data;
}

/// 6 n^3 tets in the unit cube.
inline MeshData kuhn_cube(int n) {
  return kuhn_grid(n, [](int, int, int) { return true; });
}

/// Each cell of an n^3 grid with the given probability; touches itself in edges and vertices. Never
/// empty: the first cell is always there.
inline MeshData polycube(int n, double probability, std::uint64_t seed) {
  Random random(seed);
  return kuhn_grid(
      n, [&](int i, int j, int k) { return random.unit() < probability || i + j + k == 0; });
}

/// Moves the vertices strictly inside the unit cube by up to `amplitude` along each axis. At 0.1
/// cell widths all tets of kuhn_cube stay positive.
inline void perturb_inside(MeshData& data, double amplitude, std::uint64_t seed) {
  Random random(seed);
  const auto inside = [](double x) { return x > 0 && x < 1; };
  for (Vec3& p : data.vertices) {
    if (!inside(p.x) || !inside(p.y) || !inside(p.z)) continue;
    p += Vec3{random.between(-amplitude, amplitude), random.between(-amplitude, amplitude),
              random.between(-amplitude, amplitude)};
  }
}

/// kuhn_cube(n), n odd, in which every second interior vertex along each axis lies in a face of its
/// ball: two tets at each of them have no volume, exactly. They are required where `required`.
inline MeshData cube_with_flat_tets(int n, bool required) {
  MeshData data = kuhn_cube(n);
  for (Vec3& p : data.vertices) {
    const auto at = [&](double x) { return int(std::lround(x * n)); };
    if (at(p.x) % 2 == 0 || at(p.y) % 2 == 0 || at(p.z) % 2 == 0) continue;
    if (at(p.x) == n || at(p.y) == n || at(p.z) == n) continue;
    p = {double(at(p.x) + 1) / n, p.y + 0.6 / n, p.z + 0.3 / n};
  }
  const auto in_plane = [&](const std::array<std::int32_t, 4>& t) {
    for (int k = 1; k < 4; ++k)
      if (data.vertices[t[k]].x != data.vertices[t[0]].x) return false;
    return true;
  };
  for (std::size_t t = 0; required && t < data.tets.size(); ++t)
    if (in_plane(data.tets[t])) data.required_tets.push_back(std::int32_t(t));
  return data;
}

/// Gives each tet the reference ref_of(centroid).
template <class RefOf>
void set_refs(MeshData& data, RefOf&& ref_of) {
  for (std::size_t t = 0; t < data.tets.size(); ++t) {
    Vec3 sum;
    for (const std::int32_t v : data.tets[t]) sum += data.vertices[v];
    data.tet_refs[t] = ref_of(sum * 0.25);
  }
}

/// kuhn_cube(n) mapped to a column that is square below and round above: the ridges at its four
/// sides fade on the way up.
inline MeshData fading_column(int n) {
  MeshData data = kuhn_cube(n);
  for (Vec3& p : data.vertices) {
    const double x = 2 * p.x - 1, y = 2 * p.y - 1;
    const double round_x = x * std::sqrt(1 - y * y / 2), round_y = y * std::sqrt(1 - x * x / 2);
    p = {std::lerp(x, round_x, p.z), std::lerp(y, round_y, p.z), 2 * p.z};
  }
  return data;
}

/// kuhn_cube(n) mapped to the ball of radius 1 around the origin; all tets are positive.
inline MeshData ball(int n) {
  MeshData data = kuhn_cube(n);
  for (Vec3& p : data.vertices) {
    const Vec3 q = 2 * p - Vec3{1, 1, 1};
    const double x = q.x * q.x, y = q.y * q.y, z = q.z * q.z;
    p = {q.x * std::sqrt(1 - y / 2 - z / 2 + y * z / 3),
         q.y * std::sqrt(1 - z / 2 - x / 2 + z * x / 3),
         q.z * std::sqrt(1 - x / 2 - y / 2 + x * y / 3)};
  }
  return data;
}

/// `data` with vertices and tets in a random order, and each tet turned by a random even
/// permutation.
inline MeshData shuffled(const MeshData& data, std::uint64_t seed) {
  Random random(seed);
  const std::vector<std::int32_t> to = random_order(data.vertices.size(), random);
  const std::vector<std::int32_t> from = random_order(data.tets.size(), random);
  MeshData out = data;
  for (std::size_t v = 0; v < to.size(); ++v) {
    out.vertices[to[v]] = data.vertices[v];
    out.vertex_refs[to[v]] = data.vertex_refs[v];
  }
  for (std::size_t t = 0; t < from.size(); ++t) {
    const auto& tet = data.tets[from[t]];
    for (int k = 0; k < 4; ++k) out.tets[t][k] = to[tet[k]];
    std::rotate(out.tets[t].begin(), out.tets[t].begin() + random.below(3),
                out.tets[t].begin() + 3);
    out.tet_refs[t] = data.tet_refs[from[t]];
  }
  return out;
}

}  // namespace cavea::test
