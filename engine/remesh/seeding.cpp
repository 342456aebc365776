#include "cavea/remesh/seeding.h"

#include <algorithm>
#include <cmath>

#include "cavea/base/atomic.h"
#include "cavea/base/parallel.h"
#include "cavea/geometry/metric.h"
#include "cavea/mesh/compact.h"
#include "cavea/mesh/statistics.h"
#include "cavea/part/order.h"
#include "cavea/part/seed.h"
#include "cavea/remesh/lattice_cell.h"

namespace cavea {
namespace {

/// The coarsest lattice has this many cells in the mesh's diagonal: then a cavity is not much of
/// the whole.
constexpr double kCoarsest = 4;
/// Levels below hmax: sizes between are never more different.
constexpr int kMostLevels = 40;

/// So few of a level's vertices are left where they come to be, as sorting them takes more time.
constexpr double kManySeeds = 0.1;

/// Better tets are not offered swaps while lengths are adapted; those of the lattices are well
/// above.
constexpr double kGoodTet = 0.75;

bool conforms(const TetMesh& m, TetId t) {
  return std::ranges::all_of(kEdgeVertices, [&](const auto& e) {
    const VertexId a = m.tets[t][e[0]], b = m.tets[t][e[1]];
    const double length = metric_length(distance(m.points[a], m.points[b]), m.sizes[a], m.sizes[b]);
    return length >= kShortEdge && length <= kLongEdge;
  });
}

/// Such a tet need not be asked for anything.
bool is_good(const TetMesh& m, TetId t) { return m.qualities[t] >= kGoodTet && conforms(m, t); }

}  // namespace

void tag_replaceable(TetMesh& mesh) {
  std::vector<std::int32_t> balance(mesh.points.size(), 0);  // good tets less others
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    const std::int32_t one = is_good(mesh, TetId(t)) ? 1 : -1;
    for (const VertexId v : mesh.tets[t]) atomic_add(balance[std::size_t(v)], one);
  });
  parallel_for(mesh.points.size(), [&](std::size_t v) {
    Tag& tags = mesh.vertex_tags[v];
    if (tag::is_unbound(tags) && balance[v] < 0) tags |= tag::kReplaceable;
  });
}

std::int64_t seed_interior(TetMesh& mesh, const SizeLaw& law, const std::atomic<bool>* cancel,
                           VerdictTable& verdicts) {
  SeedOptions options;
  options.growth = law.growth();
  options.largest = law.hmax;
  options.cancel = cancel;
  if (law.field) options.size = [&](const Vec3& p, double bound) { return law.bounded(p, bound); };
  // Unless the caller gives sizes, the largest one is that of most of the volume: it is to fit.
  const double cell = law.field ? fitting_cell(mesh, law) : kLatticeCell * law.hmax;
  const double smallest = *std::ranges::min_element(mesh.sizes);
  const int levels = std::clamp(int(std::ceil(std::log2(law.hmax / smallest))), 0, kMostLevels);
  options.lattice.cell = std::ldexp(cell, -levels);
  const double cells = box_diagonal(mesh) / (kCoarsest * options.lattice.cell);
  const int coarsest = std::max(0, int(std::floor(std::log2(cells))));
  std::int64_t seeds = 0;
  for (int level = coarsest; level >= 0; --level) {
    const VerdictTable result = seed_level(mesh, options, level, coarsest);
    const std::int64_t inserted = result.accepted(Operator::kVertexInsert);
    // New numbers are those of blocks and colours, far from what is beside them.
    const bool many = double(inserted) > kManySeeds * double(mesh.points.size());
    if (many && mesh.tets.size() >= kNearAnyway)
      sort_along_curve(mesh);
    else
      compact(mesh);
    seeds += inserted;
    verdicts += result;
  }
  parallel_for(mesh.points.size(),
               [&](std::size_t v) { mesh.vertex_tags[v] &= Tag(~tag::kReplaceable); });
  return seeds;
}

void trust_good_tets(TetMesh& mesh) {
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    if (is_good(mesh, TetId(t))) mesh.tet_flags[t] &= std::uint8_t(~tet_flag::kAskAll);
  });
}

}  // namespace cavea
