#include "cavea/implicit/recovered_gradients.h"

#include <algorithm>
#include <cmath>

#include "cavea/base/buckets.h"
#include "cavea/base/parallel.h"

namespace cavea {
namespace {

/// The gradient of the linear function on a tet, times six times its volume.
Vec3 weighted_gradient(const TetMesh& mesh, std::size_t t, std::span<const double> values) {
  const auto& v = mesh.tets[t];
  const Vec3 &o = mesh.points[v[0]], a = mesh.points[v[1]] - o, b = mesh.points[v[2]] - o,
             c = mesh.points[v[3]] - o;
  const double at_o = values[v[0]];
  return cross(b, c) * (values[v[1]] - at_o) + cross(c, a) * (values[v[2]] - at_o) +
         cross(a, b) * (values[v[3]] - at_o);
}

double six_volumes(const TetMesh& mesh, std::size_t t) {
  const auto& v = mesh.tets[t];
  const Vec3& o = mesh.points[v[0]];
  return dot(mesh.points[v[1]] - o, cross(mesh.points[v[2]] - o, mesh.points[v[3]] - o));
}

/// The smaller of two numbers of one sign; 0 if they are of different ones.
double least_common(double x, double y) {
  if (x * y <= 0) return 0;
  return std::abs(x) < std::abs(y) ? x : y;
}

/// The zero in [0, 1] of from (1 - t) + to t + bend t (1 - t), where from and to are of different
/// signs, so that there is one.
double zero_of_parabola(double from, double to, double bend) {
  const double slope = to - from + bend;  // at t = 0
  const double root = std::sqrt(std::max(slope * slope + 4 * bend * from, 0.0));
  // The slope at the zero is of the sign of to - from; of two forms of it one cancels nothing.
  const double there = std::copysign(root, to - from);
  const double zero =
      slope * there > 0 ? -2 * from / (slope + there) : (slope - there) / (2 * bend);
  return std::clamp(zero, 0.0, 1.0);
}

}  // namespace

RecoveredGradients::RecoveredGradients(const TetMesh& mesh, std::span<const double> values)
    : mesh_(mesh), values_(values), gradients_(values.size()) {
  Buckets balls(mesh.tets.size(), mesh.points.size(), [&](std::size_t t, auto&& put) {
    if (!mesh.tet_alive(TetId(t))) return;
    for (const VertexId v : mesh.tets[t]) put(v, std::uint32_t(t));
  });
  parallel_for(gradients_.size(), [&](std::size_t v) {
    const auto ball = balls.of(v);
    std::ranges::sort(ball);  // sums are to be the same in any order of the threads
    Vec3 sum;
    double volume = 0;
    for (const std::uint32_t t : ball) {
      sum += weighted_gradient(mesh, t, values);
      volume += six_volumes(mesh, t);
    }
    if (volume > 0) gradients_[v] = sum / volume;
  });
}

double RecoveredGradients::zero_on_edge(VertexId a, VertexId b) const {
  const double from = values_[a], to = values_[b];
  const Vec3 way = mesh_.points[b] - mesh_.points[a];
  const double rise = to - from,
               bend = least_common(dot(gradients_[a], way) - rise, rise - dot(gradients_[b], way));
  return zero_of_parabola(from, to, bend);
}

}  // namespace cavea
