// Walks over a mesh: the ball of each vertex, the shell of an edge of each tet, in random order.
#include <benchmark/benchmark.h>

#include "cavea/mesh/local.h"
#include "meshes.h"

namespace {

using namespace cavea;

/// Counts the items in `order`, and the tets that were gathered for them.
void report(benchmark::State& state, std::size_t items, std::int64_t tets) {
  state.SetItemsProcessed(state.iterations() * std::int64_t(items));
  state.counters["tets_each"] = double(tets) / (double(state.iterations()) * double(items));
}

void ball(benchmark::State& state) {
  const TetMesh& mesh = bench::lattice(state.range(0));
  const std::vector<std::int32_t> order = bench::random_order(mesh.points.size());
  TetMarker marker;
  Ball ball;
  std::int64_t tets = 0;
  for (auto _ : state)
    for (const VertexId v : order) {
      gather_ball(mesh, v, marker, ball);
      tets += std::int64_t(ball.tets.size());
    }
  report(state, order.size(), tets);
}
BENCHMARK(ball)->Arg(bench::kSmall)->Arg(bench::kLarge);

void shell(benchmark::State& state) {
  const TetMesh& mesh = bench::lattice(state.range(0));
  const std::vector<std::int32_t> order = bench::random_order(mesh.tets.size());
  Shell shell;
  std::int64_t tets = 0;
  for (auto _ : state)
    for (const TetId t : order) {
      const int* edge = kEdgeVertices[t % 6];
      gather_shell(mesh, t, edge[0], edge[1], shell);
      tets += std::int64_t(shell.tets.size());
    }
  report(state, order.size(), tets);
}
BENCHMARK(shell)->Arg(bench::kSmall)->Arg(bench::kLarge);

}  // namespace
