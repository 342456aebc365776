#pragma once
#include <CLI/App.hpp>
#include <string>

namespace cavea::program {

/// The command line of `cavea info`.
struct InfoArguments {
  std::string file;
  std::string json;  ///< empty: none
};

/// Adds the command; parsing fills `arguments`, which must outlive `app`.
CLI::App* add_info_command(CLI::App& app, InfoArguments& arguments);

/// Measures a mesh and says whether it is sound. \return the exit status; \throw InputError, ...
int run_info(const InfoArguments& arguments);

}  // namespace cavea::program
