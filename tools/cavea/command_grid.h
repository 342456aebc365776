#pragma once
#include <CLI/App.hpp>
#include <string>

#include "cavea/vdb/sample_grids.h"

namespace cavea::program {

/// The command line of `cavea grid`.
struct GridArguments {
  std::string shape, surface, output;
  GridSettings settings;
};

/// Adds the command; parsing fills `arguments`, which must outlive `app`.
CLI::App* add_grid_command(CLI::App& app, GridArguments& arguments);

/// Writes a sample grid. \return the exit status; \throw InputError, OptionError, OutputError
int run_grid(const GridArguments& arguments);

}  // namespace cavea::program
