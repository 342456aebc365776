// The edge swap as a pass asks for it: gather the shell, search the best triangulation of the ring.
// What `shell` takes is part of it. Nothing is committed, so that all turns do the same.
#include <benchmark/benchmark.h>

#include "cavea/mesh/build.h"
#include "cavea/operator/edge_swap.h"
#include "cavea/surface/features.h"
#include "meshes.h"
#include "support/meshes.h"

namespace {

using namespace cavea;

/// Of each of the two meshes: 3000 tets that stay in the caches, 300,000 that do not.
constexpr std::int64_t kFewTets = 3000, kManyTets = 300000;

/// Swaps of interior edges ask nothing of the surface, but want to have one.
SurfaceModel some_surface() {
  TetMesh mesh = build(test::single_tet()).mesh;
  classify_features(mesh, {});
  return SurfaceModel(mesh, {.tolerance = 0.01, .max_bulge = 0.03, .hmin = 0.1, .hmax = 1});
}

void edge_swap(benchmark::State& state) {
  const std::int64_t ring = state.range(0), count = state.range(1) / ring;
  const TetMesh& mesh = bench::shells(ring, count);
  const std::vector<std::int32_t> order = bench::random_order(std::size_t(count));
  const SurfaceModel surface = some_surface();
  OperatorContext context(mesh, surface);
  Cavity cavity;
  std::int64_t accepted = 0;
  for (auto _ : state)
    for (const std::int32_t i : order) {
      gather_shell(mesh, TetId(i * ring), 0, 1, context.shell);
      accepted += cavea::edge_swap(context, cavity) == Verdict::kAccept;
    }
  state.SetItemsProcessed(state.iterations() * count);
  state.counters["accepted"] = double(accepted) / (double(state.iterations()) * double(count));
}
BENCHMARK(edge_swap)
    ->ArgNames({"ring", "tets"})
    ->ArgsProduct({{4, 5, 6, 7, 8}, {kFewTets, kManyTets}});

}  // namespace
