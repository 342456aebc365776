#include "cavea/part/round.h"

#include <algorithm>

#include "cavea/base/parallel.h"
#include "cavea/mesh/compact.h"
#include "cavea/mesh/wanted_tets.h"
#include "cavea/part/extract.h"
#include "cavea/partition/blocks.h"

namespace cavea {
namespace {

/// Below this a mesh is one part: the interfaces would be most of it.
constexpr std::int64_t kOnePart = 12000;
/// A part's working set at this size is about that of a core's L2 cache.
constexpr std::int64_t kTetsPerPart = 64000;
/// Parts enough to keep many cores busy with meshes that are not small.
constexpr int kManyParts = 16;
constexpr std::int64_t kManyPartsAbove = 100000;

std::vector<std::int32_t> label_parts(const TetMesh& m, int parts) {
  const std::size_t n = m.tets.size();
  std::vector<Vec3> centers(n);
  std::vector<float> work(n);
  std::vector<std::array<std::int32_t, 4>> neighbors(n);
  parallel_for(n, [&](std::size_t t) {
    const auto [a, b, c, d] = m.corners(TetId(t));
    centers[t] = (a + b + c + d) / 4;
    work[t] = float(1 + wanted_tets(m, TetId(t)));
    for (int f = 0; f < 4; ++f) {
      const FaceLink link = m.across(TetId(t), f);
      neighbors[t][f] = link.is_tet() ? link.tet() : kNone;
    }
  });
  // A face is spared for each of its vertices that was on the interface.
  constexpr std::int32_t kSpare = 10;
  auto weight = [&](std::int32_t t, int f) {
    std::int32_t w = 1;
    for (int k : kFaceVertices[f])
      if (m.vertex_tags[m.tets[t][k]] & tag::kWasInterface) w += kSpare;
    return w;
  };
  return partition_items({centers, neighbors, work, weight}, parts);
}

RoundResult run_whole(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings) {
  RoundResult result{run_cycle(mesh, surface, settings), 1};
  compact(mesh);
  return result;
}

}  // namespace

int part_count(std::int64_t tets) {
  if (tets < kOnePart) return 1;
  const std::int64_t by_size = (tets + kTetsPerPart - 1) / kTetsPerPart;
  if (tets > kManyPartsAbove) return int(std::max<std::int64_t>(by_size, kManyParts));
  return int(std::max<std::int64_t>(2, tets * kManyParts / kManyPartsAbove));
}

RoundResult run_round(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings,
                      std::vector<std::int32_t>* part_of_tet) {
  const int count = part_count(std::int64_t(mesh.tets.size()));
  if (part_of_tet) part_of_tet->clear();
  if (count == 1) {
    const RoundResult result = run_whole(mesh, surface, settings);
    if (part_of_tet) part_of_tet->assign(mesh.tets.size(), 0);
    return result;
  }
  std::vector<Part> parts = extract_parts(mesh, label_parts(mesh, count), count);
  const std::size_t vertices = mesh.points.size(), triangles = mesh.triangles.size();
  mesh = {};
  std::vector<CycleResult> results(parts.size());
  // Largest first, so that the last to finish is small.
  std::vector<std::size_t> order(parts.size());
  for (std::size_t p = 0; p < order.size(); ++p) order[p] = p;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return parts[a].mesh.tets.size() > parts[b].mesh.tets.size();
  });
  parallel_tasks(parts.size(), [&](std::size_t i) {
    Part& part = parts[order[i]];
    if (part.mesh.tets.empty()) return;
    results[order[i]] = run_cycle(part.mesh, surface, settings);
  });
  if (part_of_tet)
    for (std::size_t p = 0; p < parts.size(); ++p)
      for (std::size_t t = 0; t < parts[p].mesh.tets.size(); ++t)
        if (parts[p].mesh.tet_alive(TetId(t))) part_of_tet->push_back(std::int32_t(p));
  mesh = stitch_parts(parts, vertices, triangles);
  RoundResult result;
  result.parts = count;
  for (const CycleResult& r : results) {
    result.cycle.verdicts += r.verdicts;
    result.cycle.changes += r.changes;
    result.cycle.full |= r.full;
  }
  return result;
}

}  // namespace cavea
