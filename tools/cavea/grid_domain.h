#pragma once
#include "cavea/implicit/cut.h"
#include "remesh_arguments.h"

namespace cavea::program {

/// Whether a file is one of grids, by its extension.
bool is_grid(const std::filesystem::path& file);

struct GridCut {
  CutResult result;
  LevelSet level_set;  ///< less the isovalue
};

/// Makes a mesh of a box around the grid's level set, or of --box, fine near the level set, and
/// cuts it. Sets the lengths in `options` that follow from the box and the cut. \throw InputError,
/// OptionError
GridCut cut_by_grid(const RemeshArguments& arguments, Options& options);

}  // namespace cavea::program
