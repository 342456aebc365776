#include <algorithm>
#include <cstdint>
#include <vector>

#include "cavea/base/buckets.h"
#include "cavea/partition/blocks.h"

namespace cavea {
namespace {

/// METIS sums weights in 31 bits, over both directions of the edges and with some slack.
constexpr std::int64_t kLargestSum = std::int64_t{1} << 29;

struct Contact {
  std::int32_t block;
  std::int64_t weight;
};

/// Sorts the contacts by block and adds up those with the same one.
void merge(std::vector<Contact>& contacts) {
  std::ranges::sort(contacts, {}, &Contact::block);
  std::size_t kept = 0;
  for (const Contact& c : contacts) {
    if (kept > 0 && contacts[kept - 1].block == c.block)
      contacts[kept - 1].weight += c.weight;
    else
      contacts[kept++] = c;
  }
  contacts.resize(kept);
}

/// For each block its contacts with the blocks of higher id: one side only, so that the graph is
/// symmetric whatever the caller's weights.
std::vector<std::vector<Contact>> contacts_upwards(const Items& items, const Blocks& blocks) {
  const Buckets items_of(blocks.of_item.size(), blocks.work.size(), [&](std::size_t i, auto&& put) {
    put(blocks.of_item[i], static_cast<std::uint32_t>(i));
  });
  std::vector<std::vector<Contact>> up(blocks.work.size());
  parallel_for(
      up.size(),
      [&](std::size_t b) {
        std::vector<Contact> found;
        for (const std::uint32_t item : items_of.of(b))
          for (int f = 0; f < 4; ++f) {
            const std::int32_t j = items.neighbours[item][f];
            if (j < 0 || blocks.of_item[j] <= static_cast<std::int32_t>(b)) continue;
            found.push_back({blocks.of_item[j], std::max(1, items.weight(item, f))});
          }
        merge(found);
        up[b].assign(found.begin(), found.end());
      },
      8);
  return up;
}

std::int32_t scaled(std::int64_t weight, int shift) {
  return static_cast<std::int32_t>(std::max<std::int64_t>(1, weight >> shift));
}

/// How often a sum must be halved to be small enough for METIS.
int halvings(std::int64_t sum) {
  int shift = 0;
  while (sum >> shift > kLargestSum) ++shift;
  return shift;
}

void set_vertex_weights(Graph& graph, const std::vector<std::int64_t>& work) {
  std::int64_t sum = 0;
  for (const std::int64_t w : work) sum += w;
  const int shift = halvings(sum);
  for (const std::int64_t w : work) graph.vertex_weights.push_back(scaled(w, shift));
}

/// Both directions of every contact. Rows come out sorted: the lower neighbours of a block are
/// written before its higher ones, both in rising order.
void set_edges(Graph& graph, const std::vector<std::vector<Contact>>& up) {
  std::vector<std::int32_t> offsets(up.size() + 1, 0);
  std::int64_t sum = 0;
  for (std::size_t b = 0; b < up.size(); ++b) {
    offsets[b] += static_cast<std::int32_t>(up[b].size());
    for (const Contact& c : up[b]) ++offsets[c.block], sum += c.weight;
  }
  const int shift = halvings(sum);
  graph.neighbours.resize(exclusive_scan(offsets));
  graph.edge_weights.resize(graph.neighbours.size());
  std::vector<std::int32_t> cursor = offsets;
  auto add = [&](std::int32_t from, std::int32_t to, std::int64_t weight) {
    graph.neighbours[cursor[from]] = to;
    graph.edge_weights[cursor[from]++] = scaled(weight, shift);
  };
  for (std::size_t b = 0; b < up.size(); ++b) {
    for (const Contact& c : up[b]) {
      add(static_cast<std::int32_t>(b), c.block, c.weight);
      add(c.block, static_cast<std::int32_t>(b), c.weight);
    }
  }
  graph.offsets = std::move(offsets);
}

}  // namespace

Graph quotient_graph(const Items& items, const Blocks& blocks) {
  Graph graph;
  set_vertex_weights(graph, blocks.work);
  set_edges(graph, contacts_upwards(items, blocks));
  return graph;
}

}  // namespace cavea
