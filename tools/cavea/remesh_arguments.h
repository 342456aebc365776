#pragma once
#include <CLI/App.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cavea/mesh/build.h"
#include "cavea/remesh/options.h"
#include "implicit_arguments.h"

namespace cavea::program {

/// The command line of `cavea remesh` or `cavea implicit`, as it was typed.
struct RemeshArguments {
  std::string input;
  std::vector<std::string> outputs;
  std::string sizes;       ///< file of sizes; empty: none
  std::string surface;     ///< file of the mesh whose surface is the truth; empty: the input
  std::string parameters;  ///< file of local parameters; empty: none
  std::string report;      ///< empty: none
  std::optional<ImplicitArguments> implicit;  ///< none: nothing is cut before
  BuildOptions build;
  Options options;  ///< without angle, threads, progress and cancel
  std::optional<double> angle;
  std::optional<int> threads;
  bool no_angle = false, no_hgrad = false, no_hgradreq = false;
  bool verbose = false, quiet = false;

  /// Whether sharp edges become ridges. Those of a grid's level set are as round as its voxels:
  /// only if an angle is given.
  bool detects_ridges() const;
};

/// Adds the command and its flags; parsing fills `arguments`, which must outlive `app`.
CLI::App* add_remesh_command(CLI::App& app, RemeshArguments& arguments);
/// The same for `cavea implicit`, which cuts before it remeshes.
CLI::App* add_implicit_command(CLI::App& app, RemeshArguments& arguments);

/// The options for the library, with the file of local parameters read. \throw OptionError naming
/// the option, see validate(); InputError, see read_parameters()
Options to_options(const RemeshArguments& arguments);

}  // namespace cavea::program
