#pragma once
#include "cavea/implicit/cut.h"
#include "load.h"
#include "remesh_arguments.h"

namespace cavea::program {

/// Whether a file is one of grids, by its extension.
bool is_grid(const std::filesystem::path& file);

/// Makes a mesh of a box around the grid's level set, or of --box, fine near the level set, and
/// cuts it. \throw InputError, OptionError
CutReport cut_by_grid(const RemeshArguments& arguments, const Options& options, LoadedMesh& loaded);

}  // namespace cavea::program
