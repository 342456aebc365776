#pragma once
#include <array>
#include <cstdint>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// What was interface in the last round is remembered until it is to be forgotten.
void remember_interface(TetMesh& mesh);
void forget_interfaces(TetMesh& mesh);

/// Histograms of the tets' qualities, ten bins from 0 to 1.
struct InterfaceQuality {
  using Histogram = std::array<std::int64_t, 10>;
  Histogram at_interface{};  ///< tets with a vertex that was on an interface that is remembered
  Histogram elsewhere{};
};

/// Whether interfaces have left a trace. \pre qualities are up to date; no holes
InterfaceQuality interface_quality(const TetMesh& mesh);

}  // namespace cavea
