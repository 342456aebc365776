#include "cavea/field/mesh_size_field.h"

#include <limits>
#include <optional>

#include "cavea/base/parallel.h"
#include "cavea/geometry/closest.h"
#include "cavea/geometry/predicates.h"

namespace cavea {
namespace {

using Weights = std::array<double, 4>;

using TetVertices = std::array<VertexId, 4>;

std::vector<TetVertices> living_tets(const TetMesh& mesh) {
  std::vector<TetVertices> tets;
  for (TetId t = 0; t < TetId(mesh.tets.size()); ++t)
    if (mesh.tet_alive(t)) tets.push_back(mesh.tets[t]);
  return tets;
}

std::vector<Box> boxes_of(const std::vector<Vec3>& points, const std::vector<TetVertices>& tets) {
  std::vector<Box> boxes(tets.size());
  parallel_for(tets.size(), [&](std::size_t t) {
    for (const VertexId v : tets[t]) boxes[t].add(points[v]);
  });
  return boxes;
}

/// The barycentric coordinates of p in a tet; none if p is not inside, or the tet is so flat that
/// they would be rounding.
std::optional<Weights> weights_inside(const Vec3& p, const std::array<Vec3, 4>& c) {
  Weights w;
  if (!((w[0] = volume6(p, c[1], c[2], c[3])) >= 0)) return std::nullopt;
  if (!((w[1] = volume6(c[0], p, c[2], c[3])) >= 0)) return std::nullopt;
  if (!((w[2] = volume6(c[0], c[1], p, c[3])) >= 0)) return std::nullopt;
  if (!((w[3] = volume6(c[0], c[1], c[2], p)) >= 0)) return std::nullopt;
  if (!certainly_positive(c[0], c[1], c[2], c[3])) return std::nullopt;
  const double sum = w[0] + w[1] + w[2] + w[3];
  return Weights{w[0] / sum, w[1] / sum, w[2] / sum, w[3] / sum};
}

/// A place on the faces of a tet, as weights of its corners.
struct OnFaces {
  Weights weights{};
  double distance2 = std::numeric_limits<double>::infinity();
};

OnFaces nearest_on_faces(const Vec3& p, const std::array<Vec3, 4>& c) {
  OnFaces best;
  for (const auto& f : kFaceVertices) {
    const ClosestOnTriangle at = closest_on_triangle(p, c[f[0]], c[f[1]], c[f[2]]);
    if (!(at.distance2 < best.distance2)) continue;
    best = {{}, at.distance2};
    best.weights[f[0]] = 1 - at.u - at.v;
    best.weights[f[1]] = at.u;
    best.weights[f[2]] = at.v;
  }
  return best;
}

}  // namespace

MeshSizeField::MeshSizeField(const TetMesh& mesh)
    : points_(mesh.points),
      sizes_(mesh.sizes),
      tets_(living_tets(mesh)),
      tree_(boxes_of(points_, tets_)) {
  std::vector<TetVertices> by_slot(tets_.size());
  parallel_for(by_slot.size(),
               [&](std::size_t slot) { by_slot[slot] = tets_[tree_.order()[slot]]; });
  tets_ = std::move(by_slot);
}

MeshSizeField::Corners MeshSizeField::corners(std::size_t slot) const {
  const auto& v = tets_[slot];
  return {points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]]};
}

double MeshSizeField::weigh(std::size_t slot, const Weights& weights) const {
  double size = 0;
  for (int k = 0; k < 4; ++k) size += weights[k] * sizes_[tets_[slot][k]];
  return size;
}

/// The tets whose box holds p are asked until one has it; where several do, on a common face, they
/// agree.
bool MeshSizeField::find_inside(const Vec3& p, double& size) const {
  return tree_.any_overlapping({p, p}, [&](std::size_t slot) {
    const std::optional<Weights> weights = weights_inside(p, corners(slot));
    if (weights) size = weigh(slot, *weights);
    return weights.has_value();
  });
}

double MeshSizeField::at_nearest(const Vec3& p) const {
  double size = 0, bound2 = std::numeric_limits<double>::infinity();
  tree_.visit_near(p, bound2, [&](std::size_t slot) {
    const OnFaces at = nearest_on_faces(p, corners(slot));
    if (at.distance2 < bound2) bound2 = at.distance2, size = weigh(slot, at.weights);
  });
  return size;
}

double MeshSizeField::operator()(const Vec3& p) const {
  double size = 0;
  return find_inside(p, size) ? size : at_nearest(p);
}

}  // namespace cavea
