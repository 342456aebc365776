#pragma once
#include <vector>

#include "cavea/field/size_regions.h"

namespace cavea {

/// The smallest size of the spheres that hold a point, infinity where none does.
SizeField field_inside(std::vector<SizeSphere> spheres);

}  // namespace cavea
