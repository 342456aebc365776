#include "cavea/part/region.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "cavea/base/id_map.h"
#include "cavea/base/ids_where.h"
#include "cavea/base/parallel.h"
#include "cavea/mesh/compact.h"
#include "cavea/mesh/fill_holes.h"
#include "cavea/mesh/local.h"
#include "cavea/mesh/renumber.h"

namespace cavea {
namespace {

/// Where less than this share of the mesh is holes it is worth not to touch the rest.
constexpr std::size_t kFewHoles = 64;

/// The same where less is asked. One asked tet costs as much as 200 that are looked at, which the
/// threads share, two or three at least.
constexpr std::size_t kFewAsked = 512;

std::size_t count_holes(const TetMesh& m) {
  return std::size_t(count_where(m.tets.size(), [&](TetId t) { return !m.tet_alive(t); }));
}

/// Many tets and those around, by marks on all.
std::vector<TetId> with_layers_of_many(const TetMesh& m, const std::vector<TetId>& tets,
                                       int layers) {
  std::vector<std::uint8_t> active(m.tets.size(), 0), near(m.points.size(), 0);
  parallel_for(tets.size(), [&](std::size_t i) { active[tets[i]] = 1; });
  for (int layer = 0; layer < layers; ++layer) {
    parallel_for(m.tets.size(), [&](std::size_t t) {
      if (!active[t]) return;
      for (const VertexId v : m.tets[t])
        std::atomic_ref(near[v]).store(1, std::memory_order_relaxed);
    });
    parallel_for(m.tets.size(), [&](std::size_t t) {
      for (const VertexId v : m.tets[t]) active[t] |= near[v];
    });
  }
  return ids_where(active.size(), [&](TetId t) { return active[t] != 0; });
}

}  // namespace

std::vector<TetId> with_layers(const TetMesh& m, std::vector<TetId> tets, int layers) {
  if (tets.size() == m.tets.size()) return tets;
  return kFewAsked * tets.size() < m.tets.size() ? with_layers_of_few(m, std::move(tets), layers)
                                                 : with_layers_of_many(m, tets, layers);
}

std::vector<TetId> with_layers_of_few(const TetMesh& m, std::vector<TetId> tets, int layers) {
  IdMap reached, vertices;
  const auto is_new = [](IdMap& ids, std::int32_t id) {
    return std::exchange(ids[id], 1) == IdMap::kNew;
  };
  for (const TetId t : tets) reached[t] = 1;
  std::vector<TetId> ball;
  for (std::size_t begin = 0; layers > 0; --layers) {
    const std::size_t end = tets.size();
    for (; begin < end; ++begin)
      for (const VertexId v : m.tets[tets[begin]]) {
        if (!is_new(vertices, v)) continue;
        small_ball(m, v, ball);
        for (const TetId t : ball)
          if (is_new(reached, t)) tets.push_back(t);
      }
  }
  std::sort(tets.begin(), tets.end());
  return tets;
}

void remove_holes(TetMesh& m, std::vector<std::int32_t>& of_tet) {
  if (kFewHoles * count_holes(m) < m.tets.size()) return fill_holes(m, &of_tet);
  living_tets(m).keep_in(of_tet);
  compact(m);
}

}  // namespace cavea
