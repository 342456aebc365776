#pragma once
#include <CLI/App.hpp>
#include <string>
#include <vector>

#include "cavea/implicit/cut.h"

namespace cavea::program {

/// What `cavea implicit` is told beyond `cavea remesh`, as it was typed.
struct ImplicitArguments {
  std::string values;  ///< file of the level set's values at the vertices
  std::string keep = "both";
  std::vector<std::string> reference_map;  ///< "REF:IN:OUT" or "REF:keep"
  CutOptions cut;                          ///< without what the two above say
};

void add_cut_flags(CLI::App& command, ImplicitArguments& arguments);

/// The options for the library. \throw OptionError naming the entry of --reference-map
CutOptions to_cut_options(const ImplicitArguments& arguments);

}  // namespace cavea::program
