#include "cavea/part/run_parts.h"

#include "cavea/base/largest_first.h"
#include "cavea/base/parallel.h"

namespace cavea {

CycleResult run_parts(std::vector<Part>& parts, const SurfaceModel& surface,
                      const CycleSettings& settings) {
  const std::vector<std::size_t> order =
      largest_first(parts.size(), [&](std::size_t p) { return parts[p].mesh.tets.size(); });
  std::vector<CycleResult> results(parts.size());
  parallel_tasks(parts.size(), [&](std::size_t i) {
    Part& part = parts[order[i]];
    if (!part.mesh.tets.empty()) results[order[i]] = run_cycle(part.mesh, surface, settings);
  });
  CycleResult sum;
  for (const CycleResult& r : results) sum += r;
  return sum;
}

}  // namespace cavea
