#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cavea/remesh/options.h"

namespace cavea::program {

/// What a file of local parameters asks for; docs/parameters.md describes both formats.
struct Parameters {
  std::vector<LocalParameters> local;
  std::vector<SizeRegion> regions;
};

/// Reads a file; the extension says the format: .json or mmg's .mmg3d.
/// \throw InputError naming the file and the line or the place in the JSON text
Parameters read_parameters(const std::filesystem::path& file);

/// The same of a text; `name` is for messages.
Parameters parse_parameters_json(const std::string& text, const std::string& name);
Parameters parse_parameters_mmg3d(const std::string& text, const std::string& name);

}  // namespace cavea::program
