#include "cavea/partition/kway.h"

#include <metis.h>

#include <mutex>
#include <numeric>
#include <string>
#include <type_traits>

#include "cavea/base/error.h"

namespace cavea {
namespace {

static_assert(std::is_same_v<idx_t, std::int32_t>, "Graph is handed to METIS without a copy");

/// Any fixed number: it makes the labels a function of the graph alone.
constexpr idx_t kSeed = 1;

/// METIS keeps its random state in the process, so two calls at once would mix their sequences.
std::mutex& metis_mutex() {
  static std::mutex mutex;
  return mutex;
}

/// METIS takes pointers to mutable data but reads only (it shifts the indices in place for Fortran
/// numbering alone).
idx_t* data_or_null(const std::vector<std::int32_t>& v) {
  return v.empty() ? nullptr : const_cast<idx_t*>(v.data());
}

}  // namespace

std::vector<std::int32_t> kway(const Graph& graph, int parts) {
  std::vector<std::int32_t> labels(graph.size(), 0);
  if (parts <= 1) return labels;
  if (graph.size() <= parts) {
    std::iota(labels.begin(), labels.end(), 0);
    return labels;
  }
  idx_t options[METIS_NOPTIONS];
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = kSeed;
  idx_t vertices = graph.size(), constraints = 1, wanted = parts, cut = 0;
  // An edgeless graph still needs an array to point to.
  idx_t nothing = 0;
  idx_t* neighbours = graph.neighbours.empty() ? &nothing : data_or_null(graph.neighbours);
  const std::lock_guard lock(metis_mutex());
  const int status = METIS_PartGraphKway(&vertices, &constraints, data_or_null(graph.offsets),
                                         neighbours, data_or_null(graph.vertex_weights), nullptr,
                                         data_or_null(graph.edge_weights), &wanted, nullptr,
                                         nullptr, options, &cut, labels.data());
  if (status != METIS_OK)
    throw InternalError("METIS_PartGraphKway failed with status " + std::to_string(status));
  return labels;
}

}  // namespace cavea
