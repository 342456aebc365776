#pragma once
// Meshes with a surface model, for the tests.
#include <cmath>
#include <utility>

#include "cavea/mesh/build.h"
#include "cavea/surface/features.h"
#include "cavea/surface/surface_model.h"
#include "support/meshes.h"

namespace cavea::test {

/// A classified mesh and the model of its surface.
struct Modelled {
  TetMesh mesh;
  SurfaceModel model;
  int patches;
};

/// Bounds that bind nowhere on the shapes below.
inline constexpr SurfaceModel::Settings kSettings{0.001, 0.5, 1e-3, 10};

inline Modelled modelled(TetMesh mesh, const FeatureOptions& options = {}) {
  const int patches = classify_features(mesh, options);
  SurfaceModel model(mesh, kSettings);
  return {std::move(mesh), std::move(model), patches};
}

inline Modelled modelled_cube(int n) { return modelled(build(kuhn_cube(n)).mesh); }

/// The ball of radius 1 around the origin.
inline Modelled modelled_ball(int n) { return modelled(build(ball(n)).mesh); }

/// The cylinder of radius 1 around the z axis from 0 to 1.
inline Modelled modelled_cylinder(int n) {
  MeshData data = kuhn_cube(n);
  for (Vec3& p : data.vertices) {
    const double x = 2 * p.x - 1, y = 2 * p.y - 1;
    p = {x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2), p.z};
  }
  return modelled(build(data).mesh);
}

inline Vec3 random_point(Random& random, double low, double high) {
  const double x = random.between(low, high), y = random.between(low, high);
  return {x, y, random.between(low, high)};
}

/// Uniform on the unit sphere.
inline Vec3 random_direction(Random& random) {
  for (;;) {
    const Vec3 p = random_point(random, -1, 1);
    if (norm2(p) <= 1 && norm2(p) > 0.01) return normalized(p);
  }
}

}  // namespace cavea::test
