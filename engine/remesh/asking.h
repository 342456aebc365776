#pragma once
// What tets are asked: see "Ask only what has changed" in docs/architecture.md.
#include <cstdint>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// All tets are asked everything, or `what` of it.
void ask_all(TetMesh& mesh, std::uint8_t what = tet_flag::kAskAll);

/// No tet is asked any more.
void ask_nothing(TetMesh& mesh);
bool is_nothing_asked(const TetMesh& mesh);

/// Asks the lengths of tets at vertices whose wanted size was another one.
void ask_changed_lengths(TetMesh& mesh, const std::vector<float>& sizes_before);

}  // namespace cavea
