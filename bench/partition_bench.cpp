// Cutting a mesh of a million tets into parts: its time, and how much of the mesh is then at an
// interface, from a part a core to many more parts than cores.
#include <benchmark/benchmark.h>

#include <algorithm>

#include "cavea/base/parallel.h"
#include "cavea/partition/blocks.h"
#include "meshes.h"

namespace {

using namespace cavea;

constexpr std::int64_t kMillion = 55;  // bricks along an edge: 998,250 tets

struct Dual {
  std::vector<Vec3> centers;
  std::vector<std::array<std::int32_t, 4>> neighbours;

  explicit Dual(const TetMesh& mesh) {
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const auto [a, b, c, d] = mesh.corners(TetId(t));
      centers.push_back((a + b + c + d) / 4);
      auto& behind = neighbours.emplace_back();
      for (int f = 0; f < 4; ++f) {
        const FaceLink link = mesh.across(TetId(t), f);
        behind[std::size_t(f)] = link.is_tet() ? link.tet() : kNone;
      }
    }
  }
};

/// The share of the tets with a vertex that tets of another part have, too: what a round leaves for
/// the next one.
double interface_share(const TetMesh& mesh, const std::vector<std::int32_t>& part) {
  constexpr std::int32_t kShared = -2;
  std::vector<std::int32_t> of_vertex(mesh.points.size(), kNone);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t)
    for (const VertexId v : mesh.tets[t]) {
      std::int32_t& seen = of_vertex[v];
      seen = seen == kNone || seen == part[t] ? part[t] : kShared;
    }
  const auto at_interface = std::ranges::count_if(mesh.tets, [&](const auto& tet) {
    return std::ranges::any_of(tet, [&](VertexId v) { return of_vertex[v] == kShared; });
  });
  return double(at_interface) / double(mesh.tets.size());
}

double largest_over_mean(const std::vector<std::int32_t>& part, std::int64_t parts) {
  std::vector<std::int64_t> sizes(std::size_t(parts), 0);
  for (const std::int32_t p : part) ++sizes[std::size_t(p)];
  return double(std::ranges::max(sizes)) * double(parts) / double(part.size());
}

void partition(benchmark::State& state) {
  const TetMesh& mesh = bench::lattice(kMillion);
  static const Dual dual(mesh);
  std::vector<std::int32_t> part;
  for (auto _ : state)
    run_in_arena(int(state.range(1)), [&] {
      part = partition_items({dual.centers, dual.neighbours, {}, {}}, int(state.range(0)));
    });
  state.counters["interface"] = interface_share(mesh, part);
  state.counters["imbalance"] = largest_over_mean(part, state.range(0));
}
BENCHMARK(partition)
    ->ArgNames({"parts", "threads"})
    ->ArgsProduct({{2, 16, 64, 256, 1024}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace
