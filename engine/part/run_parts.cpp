#include "cavea/part/run_parts.h"

#include <algorithm>
#include <numeric>

#include "cavea/base/parallel.h"

namespace cavea {

CycleResult run_parts(std::vector<Part>& parts, const SurfaceModel& surface,
                      const CycleSettings& settings) {
  // Largest first, so that the last to finish is small.
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return parts[a].mesh.tets.size() > parts[b].mesh.tets.size();
  });
  std::vector<CycleResult> results(parts.size());
  parallel_tasks(parts.size(), [&](std::size_t i) {
    Part& part = parts[order[i]];
    if (!part.mesh.tets.empty()) results[order[i]] = run_cycle(part.mesh, surface, settings);
  });
  CycleResult sum;
  for (const CycleResult& r : results) {
    sum.verdicts += r.verdicts;
    sum.changes += r.changes;
    sum.full |= r.full;
  }
  return sum;
}

}  // namespace cavea
