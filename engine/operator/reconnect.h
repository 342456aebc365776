#pragma once
#include "cavea/operator/context.h"

namespace cavea {

/// A last resort for bad tets: a cavity grows around tet `t`, tet by tet across the face that keeps
/// its worst quality lowest, and is filled anew in the best way without new vertices (small
/// polyhedron reconnection, Marot and Remacle 2020, arXiv 2009.00508). Stays inside the volume, in
/// one reference. Accepted where that raises the worst quality of the cavity by kQualityGain. One
/// vertex inside of it may vanish, if `removes_vertex`.
Verdict reconnect(OperatorContext& context, TetId t, bool removes_vertex, Cavity& cavity);

}  // namespace cavea
