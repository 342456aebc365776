#pragma once
#include <optional>
#include <string>
#include <vector>

#include "cavea/implicit/cut.h"
#include "cavea/implicit/project.h"
#include "remesh_arguments.h"

namespace cavea::program {

/// Whether a file is one of grids, by its extension.
bool is_grid(const std::filesystem::path& file);

/// A level set along which a mesh was cut.
struct CutLevelSet {
  std::string name;  ///< of its file, and of its grid where one was named
  CutReport report;
  std::optional<MeshedLevelSet> meshed;  ///< of a grid, less the isovalue
};

struct GridCut {
  TetMesh mesh;
  std::vector<CutLevelSet> level_sets;  ///< the first one counts where several overlap
};

/// Makes a mesh of a box around the level sets of grids, or of --box, fine near them, and cuts it.
/// Sets the lengths in `options` that follow from the box and the cut. \throw InputError,
/// OptionError
GridCut cut_by_grids(const RemeshArguments& arguments, Options& options);

}  // namespace cavea::program
