#pragma once
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Turns the face-connected components of one side over to the other one whose volume is below
/// `least`. \param sides by tet: -1 inside, 1 outside, 0 neither \param closed_only spares those
/// with a face on the boundary of the domain \returns how many
std::int64_t turn_islands(const TetMesh& mesh, std::int8_t side, double least, bool closed_only,
                          std::vector<std::int8_t>& sides);

}  // namespace cavea
