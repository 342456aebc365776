#pragma once
#include "cavea/operator/context.h"

namespace cavea {

/// Face swap (2-3): the two tets at face `f` of tet `t` become three around the edge between their
/// apices; accepted where that raises the worst quality.
Verdict face_swap(OperatorContext& context, TetId t, int f, Cavity& cavity);

}  // namespace cavea
