#include "cavea/field/gradation.h"

#include <atomic>
#include <cmath>

#include "cavea/base/parallel.h"
#include "cavea/mesh/buckets.h"

namespace cavea {

void limit_gradation(TetMesh& mesh, double h_grad) {
  const double slope = std::log(h_grad);
  // Relaxing edges until none changes has one result in any order, since each step is monotone; the
  // stamps let a sweep skip tets none of whose vertices has changed in the sweep before.
  std::vector<std::int32_t> changed(mesh.points.size(), 0);
  std::atomic<bool> again = true;
  auto relax = [&](VertexId low, VertexId high, double length, std::int32_t sweep) {
    const float from = std::atomic_ref(mesh.sizes[low]).load(std::memory_order_relaxed);
    const float bound = float(double(from) + slope * length);
    std::atomic_ref to(mesh.sizes[high]);
    if (to.load(std::memory_order_relaxed) <= bound) return;
    atomic_min(mesh.sizes[high], bound);
    std::atomic_ref(changed[high]).store(sweep, std::memory_order_relaxed);
    again.store(true, std::memory_order_relaxed);
  };
  for (std::int32_t sweep = 1; again.exchange(false); ++sweep)
    parallel_for(mesh.tets.size(), [&](std::size_t t) {
      const auto& v = mesh.tets[t];
      bool active = false;
      for (VertexId k : v)
        active |= std::atomic_ref(changed[k]).load(std::memory_order_relaxed) >= sweep - 1;
      if (!active) return;
      for (const auto& e : kEdgeVertices) {
        const VertexId a = v[e[0]], b = v[e[1]];
        const double length = distance(mesh.points[a], mesh.points[b]);
        relax(a, b, length, sweep);
        relax(b, a, length, sweep);
      }
    });
}

}  // namespace cavea
