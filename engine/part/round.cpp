#include "cavea/part/round.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/centroid.h"
#include "cavea/mesh/compact.h"
#include "cavea/mesh/wanted_tets.h"
#include "cavea/part/extract.h"
#include "cavea/part/interface_quality.h"
#include "cavea/part/region.h"
#include "cavea/part/run_parts.h"
#include "cavea/partition/blocks.h"

namespace cavea {
namespace {

/// A part's working set at this size is about that of a core's L2 cache.
constexpr std::int64_t kTetsPerPart = 64000;
/// Parts enough to keep some cores busy with meshes that are not large: until there are so many,
/// they are small, lest threads wait for the last. With 16, a third of the vertices of 400,000 tets
/// are at an interface.
constexpr int kLeastParts = 8;
constexpr std::int64_t kTetsPerSmallPart = 6250;

/// The most tets of a part where parts are to be few.
constexpr std::int64_t kTetsOfFew = 40000;

/// Even, since few parts of one size leave threads without work.
int even_count(std::int64_t tets, std::int64_t tets_per_part) {
  const std::int64_t of_two = 2 * tets_per_part;
  return int(2 * std::max<std::int64_t>(1, (tets + of_two - 1) / of_two));
}

/// Whether a cycle with these settings would ask the tet something.
bool is_asked(const TetMesh& m, std::size_t t, const CycleSettings& s) {
  const std::uint8_t flags = m.tet_flags[t];
  return (flags & tet_flag::kAskLength) ||
         ((flags & tet_flag::kAskSwap) && m.qualities[t] < s.swap_ceiling) ||
         ((flags & tet_flag::kAskMove) && s.move && m.qualities[t] <= s.move_ceiling);
}

/// The tets that are asked something and those around, ascending.
std::vector<TetId> active_tets(const TetMesh& m, const CycleSettings& settings, int layers) {
  return with_layers(
      m, ids_where(m.tets.size(), [&](TetId t) { return is_asked(m, std::size_t(t), settings); }),
      layers);
}

/// A part for each of the tets, kIdle for those that are not in the list.
std::vector<std::int32_t> label_parts(const TetMesh& m, const std::vector<TetId>& tets, int parts) {
  const std::size_t n = tets.size();
  std::vector<std::int32_t> labels(m.tets.size(), kIdle);  // first the item of a tet
  parallel_for(n, [&](std::size_t i) { labels[tets[i]] = std::int32_t(i); });
  std::vector<Vec3> centers(n);
  std::vector<float> work(n);
  std::vector<std::array<std::int32_t, 4>> neighbors(n);
  parallel_for(n, [&](std::size_t i) {
    const TetId t = tets[i];
    centers[i] = centroid(m.corners(t));
    work[i] = float(1 + wanted_tets(m, t));
    for (int f = 0; f < 4; ++f) {
      const FaceLink link = m.across(t, f);
      neighbors[i][f] = link.is_tet() ? labels[link.tet()] : kNone;
    }
  });
  // A face is spared for each of its vertices that was on the interface.
  constexpr std::int32_t kSpare = 10;
  auto weight = [&](std::int32_t i, int f) {
    std::int32_t w = 1;
    for (int k : kFaceVertices[f])
      if (m.vertex_tags[m.tets[tets[i]][k]] & tag::kWasInterface) w += kSpare;
    return w;
  };
  const std::vector<std::int32_t> part = partition_items({centers, neighbors, work, weight}, parts);
  parallel_for(n, [&](std::size_t i) { labels[tets[i]] = part[i]; });
  return labels;
}

/// Lets a mesh of which much is in the parts grow a little without being moved while they are held.
void make_room(TetMesh& m, std::size_t active) {
  // Rounds of fine and polish add fewer than the least. What has room is left where it is.
  constexpr std::size_t kMuch = 4, kLeastShare = 16, kShare = 12;
  if (kMuch * active < m.tets.size()) return;
  const auto with = [](std::size_t n, std::size_t share) { return n + n / share; };
  const std::size_t vertices = m.points.size(), tets = m.tets.size();
  if (m.points.capacity() < with(vertices, kLeastShare)) m.reserve_vertices(with(vertices, kShare));
  if (m.tets.capacity() < with(tets, kLeastShare)) m.reserve_tets(with(tets, kShare));
}

RoundResult run_whole(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings) {
  RoundResult result{run_cycle(mesh, surface, settings), 1};
  compact(mesh);
  return result;
}

}  // namespace

int part_count(std::int64_t tets, const PartSize& size) {
  if (size.tets_per_part > 0) return int((tets + size.tets_per_part - 1) / size.tets_per_part);
  if (tets < size.one_part) return 1;
  const std::int64_t by_size = (tets + kTetsPerPart - 1) / kTetsPerPart;
  const int usual = int(
      std::max<std::int64_t>(by_size, std::min(kLeastParts, even_count(tets, kTetsPerSmallPart))));
  return size.few ? std::min(even_count(tets, kTetsOfFew), usual - usual % 2) : usual;
}

RoundResult run_round(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings,
                      std::vector<std::int32_t>* part_of_tet, const PartSize& size) {
  // Memory that is not to be held beside the parts is given back; an empty list would keep it.
  if (part_of_tet) *part_of_tet = std::vector<std::int32_t>();
  std::vector<TetId> active = active_tets(mesh, settings, size.layers);
  if (active.empty()) {
    if (part_of_tet) part_of_tet->assign(mesh.tets.size(), kIdle);
    return {{}, 0};
  }
  const int count = part_count(std::int64_t(active.size()), size);
  if (count == 1 && 2 * active.size() > mesh.tets.size()) {
    const RoundResult result = run_whole(mesh, surface, settings);
    if (part_of_tet) part_of_tet->assign(mesh.tets.size(), 0);
    return result;
  }
  if (settings.insert) make_room(mesh, active.size());
  std::vector<std::int32_t> labels = label_parts(mesh, active, count);
  active = std::vector<TetId>();
  std::vector<Part> parts = extract_parts(mesh, std::exchange(labels, {}), count);
  const CycleResult cycle = run_parts(parts, surface, settings);
  std::vector<std::int32_t> part_of(mesh.tets.size(), kIdle);
  stitch_parts(mesh, parts, part_of);
  remember_interface(mesh);
  remove_holes(mesh, part_of);
  if (part_of_tet) *part_of_tet = std::move(part_of);
  return {cycle, count};
}

}  // namespace cavea
