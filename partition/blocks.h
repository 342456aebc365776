#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cavea/geometry/vec3.h"
#include "cavea/partition/graph.h"

namespace cavea {

/// What is to be cut into parts: items (tetrahedra, for the engine) with a place in space, up to
/// four neighbours each, and what they cost. The spans have one entry an item.
struct Items {
  std::span<const Vec3> positions;
  /// The item behind each face, -1 where there is none. Mutual: j lists i as often as i lists j.
  std::span<const std::array<std::int32_t, 4>> neighbours;
  /// Predicted work, or empty for equal work. What is not positive counts as next to nothing, and
  /// one item never as more than 1 / kLeavesPerPart of a part.
  std::span<const float> work = {};
  /// How much the face of an item is to be spared by the cut, at least 1 and alike from both sides;
  /// every face counts 1 where this is empty. Called from many threads.
  std::function<std::int32_t(std::int32_t item, int face)> face_weight = {};

  std::int32_t size() const { return static_cast<std::int32_t>(positions.size()); }
  std::int32_t weight(std::int32_t item, int face) const {
    return face_weight ? face_weight(item, face) : 1;
  }
};

/// No block holds more than this share of a part's work: enough blocks that their raggedness hides
/// in the majority sweeps, few enough that METIS costs little.
inline constexpr int kLeavesPerPart = 64;

/// Items grouped by leaves of an octree.
struct Blocks {
  std::vector<std::int32_t> of_item;   ///< block of each item
  std::vector<std::int64_t> work;      ///< of each block, in units of its own; positive
  std::vector<std::uint32_t> of_work;  ///< work of each item in the same units; empty: 1 each
  std::int32_t count() const { return static_cast<std::int32_t>(work.size()); }
  std::uint32_t item_work(std::int32_t item) const { return of_work.empty() ? 1 : of_work[item]; }
};

/// Cuts the items at cell boundaries of an octree, deep enough that no leaf has more than
/// 1 / kLeavesPerPart of a part's work, or than the heaviest item. Items at one place are cut by
/// index.
Blocks make_blocks(const Items& items, int parts);

/// The blocks as vertices, weighted with their work (scaled into 31 bits); an edge where items of
/// two blocks are neighbours, with the sum of their face weights (halved together until they fit).
Graph quotient_graph(const Items& items, const Blocks& blocks);

/// Moves items to the part that most of their faces, by weight, lie against, in a few sweeps; parts
/// stay within 10% of the mean work, or do not get worse. `labels` holds the part of each item.
void sweep_majority(const Items& items, const Blocks& blocks, int parts,
                    std::vector<std::int32_t>& labels);

/// A part in [0, parts) for each item: octree blocks, METIS on their quotient graph (see kway()),
/// majority sweeps. Parallel; the labels depend on the items and `parts` alone. A part is empty
/// only where there are not many times more items than parts. \throw InternalError as kway() does
std::vector<std::int32_t> partition_items(const Items& items, int parts);

}  // namespace cavea
