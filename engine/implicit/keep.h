#pragma once
#include <cstddef>
#include <functional>

#include "cavea/mesh/mesh_data.h"

namespace cavea {

/// Drops the tets that are not to be kept; vertices and triangles stay, for build() to drop.
/// \throw InputError when nothing is left
void keep_tets(MeshData& data, const std::function<bool(std::size_t)>& is_kept);

}  // namespace cavea
