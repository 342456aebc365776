#pragma once
#include <array>
#include <cstdint>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Histograms of the tets' qualities, ten bins from 0 to 1.
struct InterfaceQuality {
  using Histogram = std::array<std::int64_t, 10>;
  Histogram at_interface{};  ///< tets with a vertex that was on the interface of parts in any round
  Histogram elsewhere{};
};

/// Whether interfaces have left a trace. \pre qualities are up to date; no holes
InterfaceQuality interface_quality(const TetMesh& mesh);

}  // namespace cavea
