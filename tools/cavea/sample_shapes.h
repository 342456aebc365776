#pragma once
#include <string>
#include <vector>

#include "cavea/vdb/sample_grids.h"

namespace cavea::program {

/// The names that sample_shape() knows.
std::vector<std::string> sample_shape_names();

/// A shape in the unit box: a sphere, a torus, two spheres smoothly joined (all closed), or a
/// gyroid, which meets the box's sides. \pre the name is one of them
SampleShape sample_shape(const std::string& name);

}  // namespace cavea::program
