#pragma once
#include "bracket.h"

namespace cavea::sample {

/// Throws the vertices about that are free in the volume or on a plane, by a generator of our own
/// with a fixed seed, as far as every tet keeps a small positive quality: an input that needs work.
void distort(Bracket& bracket);

}  // namespace cavea::sample
