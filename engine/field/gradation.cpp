#include "cavea/field/gradation.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "cavea/base/atomic.h"
#include "cavea/base/parallel.h"

namespace cavea {
namespace {

double load(float& x) { return std::atomic_ref(x).load(std::memory_order_relaxed); }

/// Stamps of vertices that have changed before the first sweep, and of those that have not.
constexpr std::int32_t kChanged = 0, kUnchanged = -1;

/// Calls relax(from, to, length2), which says whether it changed the value of `to`, on all edges
/// between different values from vertices that have changed until none changes; it calls length2()
/// if it needs it. That has one result in any order where each step is monotone; the stamps let a
/// sweep skip tets none of whose vertices has changed in the sweep before.
template <class Relax>
void relax_edges(const TetMesh& mesh, std::vector<float>& values, std::vector<std::int32_t> changed,
                 Relax&& relax) {
  std::atomic<bool> again = true;
  auto stamp = [&](VertexId v, std::int32_t sweep) {
    std::atomic_ref(changed[v]).store(sweep, std::memory_order_relaxed);
    again.store(true, std::memory_order_relaxed);
  };
  for (std::int32_t sweep = 1; again.exchange(false); ++sweep)
    parallel_for(mesh.tets.size(), [&](std::size_t t) {
      const auto& v = mesh.tets[t];
      const auto is_as_first = [&](VertexId k) { return load(values[k]) == load(values[v[0]]); };
      if (std::ranges::all_of(v, is_as_first)) return;
      const auto has_changed = [&](VertexId k) {
        return std::atomic_ref(changed[k]).load(std::memory_order_relaxed) >= sweep - 1;
      };
      if (std::ranges::none_of(v, has_changed)) return;
      for (const auto& e : kEdgeVertices) {
        const VertexId a = v[e[0]], b = v[e[1]];
        const auto length2 = [&] { return distance2(mesh.points[a], mesh.points[b]); };
        if (has_changed(a) && relax(a, b, length2)) stamp(b, sweep);
        if (has_changed(b) && relax(b, a, length2)) stamp(a, sweep);
      }
    });
}

/// Whether a difference is more than the slope allows over a length: no root for most edges.
template <class Length2>
bool is_steep(double difference, double slope, Length2&& length2) {
  return difference > 0 && !(difference * difference <= slope * slope * length2());
}

std::vector<std::int32_t> all_changed(const TetMesh& mesh) {
  return std::vector<std::int32_t>(mesh.points.size(), kChanged);
}

/// Below these sizes none may come: the imposed ones, and around them what falls from them.
std::vector<float> floors_around(const TetMesh& mesh, const ImposedSizes& imposed) {
  const double slope = std::log(imposed.h_grad);
  std::vector<float> below(imposed.sizes.size());  // negative, so that the minimum is the largest
  for (std::size_t v = 0; v < below.size(); ++v) below[v] = -imposed.sizes[v];
  if (!below.empty())
    relax_edges(mesh, below, all_changed(mesh), [&](VertexId from, VertexId to, auto&& length2) {
      if (!is_steep(load(below[to]) - load(below[from]), slope, length2)) return false;
      const float bound = float(load(below[from]) + slope * std::sqrt(length2()));
      if (!(bound < load(below[to]))) return false;
      atomic_min(below[to], bound);
      return true;
    });
  for (float& x : below) x = -x;
  return below;
}

/// Lowers what is too large for the sizes around it, but for imposed sizes and below `floors`.
void lower_around(TetMesh& mesh, double h_grad, const ImposedSizes& imposed,
                  const std::vector<float>& floors, std::vector<std::int32_t> changed) {
  auto is_imposed = [&](VertexId v) { return !floors.empty() && imposed.sizes[v] > 0; };
  const double slope = std::log(h_grad), slope_at_imposed = std::log(imposed.h_grad);
  relax_edges(mesh, mesh.sizes, std::move(changed),
              [&](VertexId low, VertexId high, auto&& length2) {
                const double rise = is_imposed(low) || is_imposed(high) ? slope_at_imposed : slope;
                if (!is_steep(load(mesh.sizes[high]) - load(mesh.sizes[low]), rise, length2))
                  return false;
                float bound = float(load(mesh.sizes[low]) + rise * std::sqrt(length2()));
                if (!floors.empty()) bound = std::max(bound, floors[high]);
                // Nor if it is none: 0 times infinity.
                if (!(bound < load(mesh.sizes[high]))) return false;
                atomic_min(mesh.sizes[high], bound);
                return true;
              });
}

}  // namespace

void limit_gradation(TetMesh& mesh, double h_grad, const ImposedSizes& imposed) {
  const std::vector<float> floors = floors_around(mesh, imposed);
  for (std::size_t v = 0; v < floors.size(); ++v)
    mesh.sizes[v] = imposed.sizes[v] > 0 ? imposed.sizes[v] : std::max(mesh.sizes[v], floors[v]);
  lower_around(mesh, h_grad, imposed, floors, all_changed(mesh));
}

void limit_gradation_of_lowered(TetMesh& mesh, double h_grad, const std::vector<float>& before,
                                const ImposedSizes& imposed) {
  const std::vector<float> floors = floors_around(mesh, imposed);
  std::vector<std::int32_t> changed(before.size());
  parallel_for(before.size(), [&](std::size_t v) {
    if (!floors.empty()) mesh.sizes[v] = std::min(before[v], std::max(mesh.sizes[v], floors[v]));
    changed[v] = mesh.sizes[v] < before[v] ? kChanged : kUnchanged;
  });
  lower_around(mesh, h_grad, imposed, floors, std::move(changed));
}

}  // namespace cavea
