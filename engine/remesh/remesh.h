#pragma once
#include "cavea/field/size_field.h"
#include "cavea/mesh/tet_mesh.h"
#include "cavea/remesh/options.h"
#include "cavea/remesh/report.h"

namespace cavea {

/// Remeshes `mesh` in place (paper, section 4.3): the result meshes the same domain within
/// options.hausd of its ideal surface, with edges of the sizes that the curvature, `field`, the
/// bounds and the gradation ask for. The same input and options give the same bytes at any number
/// of threads. mesh.sizes holds the sizes that were asked for. On an exception `mesh` is unchanged.
/// \throw OptionError, Cancelled, InternalError
Report remesh(TetMesh& mesh, const SizeField& field, const Options& options);

}  // namespace cavea
