#pragma once
#include <optional>

#include "cavea/field/size_field.h"
#include "cavea/implicit/cut.h"
#include "load.h"
#include "remesh_arguments.h"

namespace cavea::program {

/// What a run begins with.
struct Prepared {
  LoadedMesh loaded;
  SizeField field;                    ///< of the sizes at the input's vertices
  std::optional<CutReport> cut;       ///< of `cavea implicit`
  std::optional<LevelSet> level_set;  ///< that of a grid, less its isovalue
};

/// Reads the input and, for `cavea implicit`, cuts it along the level set of a file: of values at
/// its vertices, or of a grid, around which a mesh is made first;
/// then the lengths in `options` that follow from it are set. \throw InputError, OptionError
Prepared prepare(const RemeshArguments& arguments, Options& options);

}  // namespace cavea::program
