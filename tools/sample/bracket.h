#pragma once
#include "cavea/mesh/mesh_data.h"

namespace cavea::sample {

/// The sample part, well-shaped: an angle bracket of 65 x 40 x 75 mm. Two lugs of 10 mm with
/// rounded ends stand at a right angle; each has a bore, and the horizontal one holds a bushing,
/// which is a material of its own (reference 2). One triangle reference for each plane or cylinder.
struct Bracket {
  MeshData mesh;
  /// For each vertex the set of surfaces (bit k: reference k + 1) that it lies on.
  std::vector<unsigned> surfaces_of_vertex;
};

/// Lies on one plane only, so it may slide on it; gives the coordinate that must not change, 3 for
/// a vertex free in the volume, -1 for one that must stay.
int fixed_axis(unsigned surfaces);

/// Builds the bracket out of mapped blocks of bricks, each cut into six tets. Uses + - * / and sqrt
/// only, so it gives the same coordinates on every IEEE machine; they are rounded to the nanometre.
Bracket make_bracket();

/// To six decimals of a millimetre.
Vec3 rounded(const Vec3& p);

}  // namespace cavea::sample
