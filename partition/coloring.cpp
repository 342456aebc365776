#include "cavea/partition/coloring.h"

#include <algorithm>
#include <bit>
#include <numeric>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

constexpr std::int32_t kUncolored = -1;

/// A bijection of 32 bits that scatters consecutive ids (the finalizer of MurmurHash3), so that
/// chains of rising priority are short and no two vertices tie.
std::uint32_t priority(std::int32_t v) {
  auto h = static_cast<std::uint32_t>(v);
  h = (h ^ h >> 16) * 0x85ebca6bu;
  h = (h ^ h >> 13) * 0xc2b2ae35u;
  return h ^ h >> 16;
}

bool ready(const Graph& graph, const std::vector<std::int32_t>& colors, std::int32_t v) {
  return std::ranges::none_of(graph.row(v), [&](std::int32_t u) {
    return colors[u] == kUncolored && priority(u) > priority(v);
  });
}

/// The smallest colour that no neighbour of higher priority has. Reads those only: they were
/// coloured in an earlier round, while others may be written at this moment.
std::int32_t smallest_free(const Graph& graph, const std::vector<std::int32_t>& colors,
                           std::int32_t v) {
  for (std::int32_t base = 0;; base += 64) {
    std::uint64_t used = 0;
    for (const std::int32_t u : graph.row(v)) {
      if (priority(u) <= priority(v)) continue;
      const std::int32_t c = colors[u] - base;
      if (c >= 0 && c < 64) used |= std::uint64_t{1} << c;
    }
    if (~used != 0) return base + std::countr_one(used);
  }
}

}  // namespace

Coloring color(const Graph& graph) {
  Coloring result;
  std::vector<std::int32_t>& colors = result.colors;
  colors.assign(graph.size(), kUncolored);
  std::vector<std::int32_t> waiting(graph.size());
  std::iota(waiting.begin(), waiting.end(), 0);
  std::vector<std::uint8_t> is_ready(waiting.size());
  while (!waiting.empty()) {
    parallel_for(waiting.size(),
                 [&](std::size_t k) { is_ready[k] = ready(graph, colors, waiting[k]); });
    parallel_for(waiting.size(), [&](std::size_t k) {
      if (is_ready[k]) colors[waiting[k]] = smallest_free(graph, colors, waiting[k]);
    });
    std::erase_if(waiting, [&](std::int32_t v) { return colors[v] != kUncolored; });
  }
  for (const std::int32_t c : colors) result.count = std::max(result.count, c + 1);
  return result;
}

}  // namespace cavea
