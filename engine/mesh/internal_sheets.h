#pragma once
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Turns internal triangles (tag::kInternal) so that those of a sheet all face the same way, that
/// of its first one: between tets of one reference nothing else says which side is which. A sheet
/// of one side only (a Moebius strip) keeps a seam where it turns. \pre triangles are attached
void orient_internal_sheets(TetMesh& mesh);

}  // namespace cavea
