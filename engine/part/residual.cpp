#include "cavea/part/residual.h"

#include <algorithm>
#include <utility>

#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/part/clusters.h"
#include "cavea/part/extract.h"
#include "cavea/part/region.h"
#include "cavea/part/run_parts.h"
#include "cavea/partition/coloring.h"

namespace cavea {
namespace {

/// Regions grow by a layer every other pass, so that what goes to and fro at a rim comes to lie
/// inside; this many passes end what would not end.
constexpr int kPasses = 20;

/// Where a pass leaves more than this share of what was blocked, as among needles, whose vertices
/// have hundreds of tets, each region blocks what the one beside it has asked. Sound meshes: a few
/// percent.
constexpr double kUnsettled = 0.8;

/// A cluster of more blocked tets than this is cut, so that regions are many and small.
constexpr std::size_t kCluster = 256;

/// The second sweep offers the last resorts; what further ones would gain is not worth their reach.
constexpr int kSweeps = 2;

bool is_blocked(const TetMesh& m, TetId t) {
  return (m.tet_flags[t] & tet_flag::kBlocked) && m.tet_alive(t);
}

TetList blocked_tets(const TetMesh& m) {
  return ids_where(m.tets.size(), [&](TetId t) { return is_blocked(m, t); });
}

/// Runs what is blocked in one mesh, which may be a part, colour by colour.
class Batches {
 public:
  Batches(TetMesh& mesh, const SurfaceModel& surface, const CycleSettings& settings, int layers,
          bool join, ResidualCount& count, VerdictTable& verdicts)
      : mesh_(mesh),
        surface_(surface),
        settings_(settings),
        layers_(layers),
        join_(join),
        count_(count),
        verdicts_(verdicts) {}

  void run() {
    std::vector<TetList> clusters = clusters_of(mesh_, blocked_tets(mesh_), kCluster);
    const Graph conflicts = conflicts_of(regions_around(clusters));
    if (join_) return run_batch(joined(std::move(clusters), conflicts));
    const Coloring coloring = color(conflicts);
    count_.colors = std::max(count_.colors, coloring.count);
    for (std::int32_t c = 0; c < coloring.count; ++c) {
      std::vector<TetList> batch;
      for (std::size_t k = 0; k < clusters.size(); ++k)
        if (coloring.colors[k] == c) batch.push_back(std::move(clusters[k]));
      run_batch(std::move(batch));
    }
  }

 private:
  std::vector<TetList> regions_around(const std::vector<TetList>& clusters) const {
    std::vector<TetList> regions(clusters.size());
    parallel_tasks(clusters.size(), [&](std::size_t k) {
      regions[k] = with_layers_of_few(mesh_, clusters[k], layers_);
    });
    return regions;
  }

  void run_batch(std::vector<TetList> clusters) {
    // Earlier batches may have done the work.
    for (TetList& cluster : clusters)
      std::erase_if(cluster, [&](TetId t) { return !is_blocked(mesh_, t); });
    std::erase_if(clusters, [](const TetList& cluster) { return cluster.empty(); });
    if (clusters.empty()) return;
    std::vector<std::int32_t> labels(mesh_.tets.size(), kIdle);
    int regions = 0;
    for (const TetList& region : regions_around(clusters))
      regions += label(region, regions, labels);
    std::vector<Part> parts = extract_parts(mesh_, labels, regions);
    const CycleResult cycle = run_parts(parts, surface_, settings_);
    stitch_parts(mesh_, parts, labels);
    verdicts_ += cycle.verdicts;
    count_.changes += cycle.changes;
    ++count_.batches;
    count_.regions += regions;
  }

  /// Regions may have come to share tets where an earlier batch has changed them: the later one
  /// then waits for the next pass.
  static bool label(const TetList& region, std::int32_t number, std::vector<std::int32_t>& labels) {
    if (std::ranges::any_of(region, [&](TetId t) { return labels[t] != kIdle; })) return false;
    for (const TetId t : region) labels[t] = number;
    return true;
  }

  TetMesh& mesh_;
  const SurfaceModel& surface_;
  const CycleSettings& settings_;
  int layers_;
  bool join_;  ///< the regions that conflict, in place of running them in turns
  ResidualCount& count_;
  VerdictTable& verdicts_;
};

/// What is blocked and all around it, as one part, so that batches do not touch the rest.
std::vector<Part> take_out(const TetMesh& mesh, TetList blocked, int layers) {
  std::vector<std::int32_t> labels(mesh.tets.size(), kIdle);
  for (const TetId t : with_layers(mesh, std::move(blocked), layers)) labels[t] = 0;
  std::vector<Part> part = extract_parts(mesh, labels, 1);
  // What is asked beside that would come to be blocked at the rims.
  for (std::uint8_t& flags : part[0].mesh.tet_flags)
    if (!(flags & tet_flag::kBlocked)) flags &= std::uint8_t(~tet_flag::kAskAll);
  return part;
}

}  // namespace

std::int64_t count_blocked(const TetMesh& mesh) { return std::int64_t(blocked_tets(mesh).size()); }

ResidualCount& ResidualCount::operator+=(const ResidualCount& next) {
  before += next.before;
  after = next.after;
  regions += next.regions;
  changes += next.changes;
  colors = std::max(colors, next.colors);
  batches += next.batches;
  return *this;
}

ResidualCount run_residual(TetMesh& mesh, const SurfaceModel& surface,
                           const CycleSettings& settings, std::vector<std::int32_t>& part_of_tet,
                           VerdictTable& verdicts) {
  CycleSettings few_sweeps = settings;
  few_sweeps.sweeps = std::min(settings.sweeps, kSweeps);
  ResidualCount count;
  TetList blocked = blocked_tets(mesh);
  count.before = std::int64_t(blocked.size());
  bool join = false;
  for (int pass = 0; !blocked.empty() && pass < kPasses; ++pass) {
    const int layers = kLayers + pass / 2;
    const auto before = double(blocked.size());
    std::vector<Part> part = take_out(mesh, std::move(blocked), layers);
    Batches(part[0].mesh, surface, few_sweeps, layers, join, count, verdicts).run();
    std::vector<std::int32_t> labels;
    stitch_parts(mesh, part, labels);
    part_of_tet.resize(mesh.tets.size(), kIdle);
    remove_holes(mesh, part_of_tet);
    blocked = blocked_tets(mesh);
    join |= double(blocked.size()) > kUnsettled * before;
  }
  count.after = std::int64_t(blocked.size());
  return count;
}

}  // namespace cavea
