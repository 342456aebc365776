#pragma once
#include <variant>
#include <vector>

#include "cavea/field/size_field.h"

namespace cavea {

/// An axis-aligned box in which edges are wanted no longer than `size`.
struct SizeBox {
  Vec3 low, high;
  double size = 0;
};

/// The same of a ball.
struct SizeSphere {
  Vec3 center;
  double radius = 0, size = 0;
};

using SizeRegion = std::variant<SizeBox, SizeSphere>;

double size_of(const SizeRegion& region);

/// The smaller of `field`, which may be empty, and of the regions' sizes. Around a region its size
/// rises with the distance as the gradation allows, so that a mesh too coarse to have a vertex in
/// it knows of it all the same. \param hgrad of that rise; >= 1, infinity for none
SizeField with_regions(SizeField field, std::vector<SizeRegion> regions, double hgrad);

}  // namespace cavea
