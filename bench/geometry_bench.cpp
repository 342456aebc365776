// Kernels that need no mesh: per call, over tets of random shapes that fit into the first cache.
#include <benchmark/benchmark.h>

#include <array>
#include <random>
#include <vector>

#include "cavea/geometry/metric.h"
#include "cavea/geometry/predicates.h"
#include "cavea/geometry/quality.h"

namespace {

using cavea::Vec3;
using Corners = std::array<Vec3, 4>;

constexpr std::size_t kTets = 256;  // 24 KiB
constexpr unsigned kSeed = 7;

std::vector<Corners> random_tets() {
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> coordinate(0, 1);
  std::vector<Corners> tets(kTets);
  for (Corners& tet : tets)
    for (Vec3& p : tet) p = {coordinate(random), coordinate(random), coordinate(random)};
  return tets;
}

template <class Kernel>
void run_over_tets(benchmark::State& state, Kernel kernel) {
  const std::vector<Corners> tets = random_tets();
  for (auto _ : state)
    for (const auto& [a, b, c, d] : tets) benchmark::DoNotOptimize(kernel(a, b, c, d));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kTets));
}

void quality(benchmark::State& state) { run_over_tets(state, cavea::tet_quality); }
BENCHMARK(quality);

void certainly_positive(benchmark::State& state) {
  run_over_tets(state, cavea::certainly_positive);
}
BENCHMARK(certainly_positive);

void orientation(benchmark::State& state) { run_over_tets(state, cavea::orientation); }
BENCHMARK(orientation);

/// The slow way of orientation(): four points of one plane, which the filter cannot tell apart.
void orientation_of_flat(benchmark::State& state) {
  const Vec3 a{0, 0, 0.1}, b{1, 0, 0.1}, c{0, 1, 0.1}, d{0.3, 0.3, 0.1};
  for (auto _ : state) benchmark::DoNotOptimize(cavea::orientation(a, b, c, d));
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(orientation_of_flat);

void metric_length(benchmark::State& state) {
  run_over_tets(state, [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3&) {
    return cavea::metric_length(cavea::distance(a, b), 0.1 + c.x, 0.1 + c.y);
  });
}
BENCHMARK(metric_length);

}  // namespace
