#pragma once
// Bodies to remesh, and what is asked of every result.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "cavea/mesh/build.h"
#include "cavea/remesh/remesh.h"
#include "cavea/surface/features.h"
#include "support/expect.h"
#include "support/meshes.h"
#include "support/shape.h"

namespace cavea::test {

inline TetMesh built(const MeshData& data) { return build(data).mesh; }

template <class Map>
MeshData mapped(MeshData data, Map&& map) {
  for (Vec3& p : data.vertices) p = map(p);
  return data;
}

/// The half of kuhn_cube(n) where x is not less than y.
inline MeshData half_cube(int n) {
  MeshData data = kuhn_cube(n);
  std::erase_if(data.tets, [&](const auto& t) {
    double x_less_y = 0;
    for (const int v : t) x_less_y += data.vertices[v].x - data.vertices[v].y;
    return x_less_y < 0;
  });
  data.tet_refs.resize(data.tets.size());
  return data;
}

/// Two references with a plane between them, which meets the boundary in a closed curve.
inline MeshData two_halves(int n) {
  MeshData data = kuhn_cube(n);
  set_refs(data, [](const Vec3& c) { return c.x + c.z / 1000 < 0.5 ? 2 : 5; });
  return data;
}

inline MeshData octants(int n) {
  MeshData data = kuhn_cube(n);
  set_refs(data, [](const Vec3& c) { return 1 + (c.x > 0.5) + 2 * (c.y > 0.5) + 4 * (c.z > 0.5); });
  return data;
}

/// Radius 1 and height 2: its two ridges are closed curves without corners.
inline MeshData cylinder(int n) {
  return mapped(kuhn_cube(n), [](const Vec3& p) {
    const double x = 2 * p.x - 1, y = 2 * p.y - 1;
    return Vec3{x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2), 2 * p.z};
  });
}

/// A plate of one layer of cells, 50 times as wide as thick.
inline MeshData thin_wall() {
  MeshData data = kuhn_grid(25, [](int, int, int k) { return k == 0; });
  for (Vec3& p : data.vertices) p.z /= 2;
  return data;
}

/// A plate with a square hole, of two layers.
inline MeshData frame() {
  return kuhn_grid(
      6, [](int i, int j, int k) { return k < 2 && !(i >= 2 && i < 4 && j >= 2 && j < 4); });
}

struct Bands {
  double worst = 0.1, mean = 0.72, conform = 90;
};

inline void expect_good(const Report& report, const Bands& bands = {}) {
  EXPECT_GE(report.after.quality.worst, bands.worst);
  EXPECT_GE(report.after.quality.mean, bands.mean);
  EXPECT_GE(report.after.lengths.conforming_percent(), bands.conform);
}

inline Options uniform(double size, int threads = 0) {
  Options options;
  options.hsiz = size;
  options.threads = threads;
  return options;
}

/// How often a run had a phase of that name.
inline std::ptrdiff_t times_of(std::string_view phase, const Report& report) {
  return std::ranges::count(report.phases, phase, &PhaseTime::phase);
}

/// Of a run whose result is sound.
inline Report report_of(const MeshData& data, const Options& options) {
  TetMesh mesh = built(data);
  const Report report = remesh(mesh, {}, options);
  expect_sound(mesh);
  return report;
}

}  // namespace cavea::test
