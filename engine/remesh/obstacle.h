#pragma once
#include <string>

#include "cavea/operator/context.h"

namespace cavea {

/// What about the domain forbids a good tet at the place of t or beside it, in words: the surface
/// meets itself at a small angle there, feature curves do, these or its walls are nearer to each
/// other than edges may be short, or the surface bends too much for edges of the wanted size. Empty
/// if none. \pre no holes, no part
std::string obstacle_of(OperatorContext& context, TetId t);

/// Whether the surface, feature curves or a tip of the domain are so sharp at t, or at poor tets
/// around, that no mesh has sound tets there. \pre no holes, no part
bool is_too_sharp(OperatorContext& context, TetId t);

}  // namespace cavea
