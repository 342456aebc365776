#pragma once
#include "cavea/field/size_field.h"
#include "grid_domain.h"
#include "load.h"
#include "remesh_arguments.h"

namespace cavea::program {

/// What a run begins with.
struct Prepared {
  LoadedMesh loaded;
  SizeField field;                      ///< of the sizes at the input's vertices
  std::vector<CutLevelSet> level_sets;  ///< of `cavea implicit`
};

/// Reads the input and, for `cavea implicit`, cuts it along the level set of a file: of values at
/// its vertices, or of grids, around which a mesh is made first;
/// then the lengths in `options` that follow from it are set. \throw InputError, OptionError
Prepared prepare(const RemeshArguments& arguments, Options& options);

}  // namespace cavea::program
