#pragma once
// Meshes for the kernels: a small one stays in the nearest caches, a large one does not.
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea::bench {

/// The unit cube in n^3 bricks of six tets each, with the vertices inside moved a little at random,
/// numbered brick by brick. Kept for the next one who asks.
const TetMesh& lattice(std::int64_t n);

/// Separate shells of `tets` positive tets each around an interior edge, which lies between the
/// local vertices 0 and 1 of the shell's tets: tet `tets * i` is one of shell i. Kept for the next
/// one who asks.
const TetMesh& shells(std::int64_t tets, std::int64_t count);

/// 0 .. n-1 in a random order, the same one every time: what is asked next is rarely near.
std::vector<std::int32_t> random_order(std::size_t n);

/// Bricks along an edge of the lattices: 3072 tets, and 384,000 (about 20 MB).
inline constexpr std::int64_t kSmall = 8, kLarge = 40;

}  // namespace cavea::bench
