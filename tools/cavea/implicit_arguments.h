#pragma once
#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cavea/implicit/cut.h"

namespace cavea::program {

/// What `cavea implicit` is told beyond `cavea remesh`, as it was typed.
struct ImplicitArguments {
  std::string values;  ///< file of the level set's values at the vertices; empty for a grid
  std::vector<std::string> below;  ///< more files of grids, of lower priority
  /// Names of grids: of each file one, or of one file several by priority; empty: the only ones.
  std::vector<std::string> grids;
  std::vector<double> box;         ///< low and high corner of the domain; empty: the grid's own
  std::optional<double> isovalue;  ///< 0 if not given, of a fog volume 0.5
  std::string keep = "both";
  std::vector<std::string> reference_map;  ///< "REF:IN:OUT" or "REF:keep"
  CutOptions cut;                          ///< without what keep, map and isovalue say
};

/// May be given again; CLI11 would let a list swallow the input's name.
void one_value_each(CLI::Option* option);

void add_cut_flags(CLI::App& command, ImplicitArguments& arguments);
/// The files after the input, so to be added after it.
void add_stack_positional(CLI::App& command, ImplicitArguments& arguments);

/// Refuses what does not go with a mesh, or with a grid. \throw OptionError naming the option
void check_level_set(const ImplicitArguments& arguments, bool is_grid);

/// The options for the library. \throw OptionError naming the entry of --reference-map
CutOptions to_cut_options(const ImplicitArguments& arguments);

}  // namespace cavea::program
