#include "cavea/implicit/project.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "cavea/base/parallel.h"
#include "cavea/implicit/interface_vertices.h"
#include "cavea/implicit/vertex_moves.h"

namespace cavea {
namespace {

/// Of the shortest edge: far more than remesh() leaves a vertex off its model.
constexpr double kReach = 0.25;

/// As in the last phase of remesh(): what is better than the floor may become a little worse.
constexpr MoveLimits kLimits{.share = 0.9, .floor = 0.4};

bool stays(const TetMesh& mesh, const InterfaceVertex& vertex) {
  const Tag tags = mesh.vertex_tags[vertex.id];
  const bool is_common_point = vertex.level_sets.size() >= 3;
  return (tags & (tag::kRequired | tag::kPinched)) || ((tags & tag::kCorner) && !is_common_point);
}

/// The distance from a point to the nearest zero on a line through it, no more than `most`: steps
/// double until the sign changes on either side.
double along_line(const LevelSet& level_set, const Vec3& p, const Vec3& direction, double most) {
  constexpr int kSteps = 20;  // the first one is a millionth of what may be: below any tolerance
  const double value = level_set.value(p);
  if (value == 0) return 0;
  for (int k = 0; k <= kSteps; ++k) {
    const double step = std::ldexp(most, k - kSteps);
    for (const Vec3& way : {direction * step, -direction * step})
      if (const double there = level_set.value(p + way); (there < 0) != (value < 0))
        return step * zero_on_edge(level_set, p, p + way, value, there);
  }
  return most;
}

/// The largest distance at vertices, edges' middles and centroid.
double off(const LevelSet& level_set, const std::array<Vec3, 3>& corners) {
  const auto& [a, b, c] = corners;
  const Vec3 normal = normalized(cross(b - a, c - a));
  const double most = std::max({distance(a, b), distance(b, c), distance(c, a)});
  double worst = 0;
  for (const Vec3& p : {a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3}) {
    const Vec3 slope = normalized(level_set.gradient(p));
    worst = std::max(worst, std::min(along_line(level_set, p, normal, most),
                                     along_line(level_set, p, slope, most)));
  }
  return worst;
}

}  // namespace

void project_onto(TetMesh& mesh, std::span<const MeshedLevelSet> level_sets) {
  std::vector<std::int32_t> refs;
  for (const MeshedLevelSet& meshed : level_sets) refs.push_back(meshed.interface_ref);
  VertexMoves moves(mesh, refs);
  for (const InterfaceVertex& vertex : interface_vertices(mesh, level_sets)) {
    if (stays(mesh, vertex)) continue;
    const VertexId v = vertex.id;
    std::vector<const LevelSet*> wanted;
    for (const std::size_t k : vertex.level_sets) wanted.push_back(&level_sets[k].level_set);
    const Vec3 step = moves.to_zero(v, wanted, kReach * moves.shortest_edge(v));
    if (norm2(step) > 0) moves.move(v, step, kLimits);
  }
}

void project_onto(TetMesh& mesh, const LevelSet& level_set, std::int32_t interface_ref) {
  project_onto(mesh, std::array{MeshedLevelSet{level_set, interface_ref}});
}

double distance_from(const TetMesh& mesh, const LevelSet& level_set, std::int32_t interface_ref) {
  return parallel_reduce(
      mesh.triangles.size(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double most = 0;
        for (std::size_t s = begin; s < end; ++s) {
          const Triangle& triangle = mesh.triangles[s];
          if (!triangle.alive() || triangle.ref != interface_ref) continue;
          const auto& v = triangle.v;
          most = std::max(
              most, off(level_set, {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]}));
        }
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
}

}  // namespace cavea
