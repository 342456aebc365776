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
  SizeField field;               ///< of the sizes at the input's vertices
  std::optional<CutReport> cut;  ///< of `cavea implicit`
};

/// Reads the input and, for `cavea implicit`, cuts it along the level set of a file: of values at
/// its vertices, or of a grid, around which a mesh is made first. \throw InputError, OptionError
Prepared prepare(const RemeshArguments& arguments, const Options& options);

}  // namespace cavea::program
