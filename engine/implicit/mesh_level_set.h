#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "cavea/geometry/box.h"
#include "cavea/implicit/cut.h"
#include "cavea/implicit/level_set.h"
#include "cavea/implicit/refine.h"

namespace cavea {

/// From a function to a mesh that remesh() can begin with: a box, fine near the level set, and cut
/// along it. \param zeros of it, one or more on each piece that is to be found; empty: they are
/// looked for on a lattice of 64 cells along the box's longest side
/// \throw InputError, OptionError as cut_along(); OptionError as box_mesh()
CutResult mesh_level_set(const Box& box, const LevelSet& level_set,
                         std::span<const OrientedPoint> zeros, const RefineOptions& refine,
                         const CutOptions& cut = {});

/// One of several level sets, as mesh_level_set() wants it.
struct StackedLevelSet {
  LevelSet level_set;
  std::span<const OrientedPoint> zeros;
  RefineOptions refine;
  std::string name;  ///< for messages; empty: none
};

/// The references that the k-th level set of a stack has, from 0: they count up.
inline std::int32_t inside_ref(const CutOptions& cut, std::size_t k) {
  return cut.material.inside + std::int32_t(k);
}
inline std::int32_t interface_ref(const CutOptions& cut, std::size_t k) {
  return cut.interface_ref + std::int32_t(k);
}

struct StackResult {
  TetMesh mesh;
  std::vector<CutReport> reports;  ///< by level set
};

/// The same for several level sets: where their insides overlap, that of the earlier one counts.
/// Each has a reference inside, and one for the triangles where its inside ends or it ends
/// another's: these are on its zero. Where two such surfaces meet, they share a curve of edges.
/// \throw InputError, OptionError as mesh_level_set(), with the name of the level set in front; an
/// InputError if nothing of an inside is left by the earlier ones; an OptionError if a reference
/// of tets would be used twice, or materials by reference are asked for
StackResult mesh_level_sets(const Box& box, std::span<const StackedLevelSet> stack,
                            const CutOptions& cut = {});

}  // namespace cavea
