#include "parameters.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>

#include "cavea/base/error.h"

namespace cavea::program {
namespace {

namespace fs = std::filesystem;

std::string read_whole(const fs::path& file) {
  if (!fs::is_regular_file(file))
    throw InputError(fmt::format("{}: there is no such file", file.string()));
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in) throw InputError(fmt::format("{}: cannot be read", file.string()));
  return text;
}

/// What no entry shows alone: two for one reference.
void check_together(const Parameters& parameters, const std::string& name) {
  Options options;
  options.local = parameters.local;
  options.size_regions = parameters.regions;
  try {
    validate(options);
  } catch (const OptionError& e) {
    throw InputError(fmt::format("{}: {}", name, e.what()));
  }
}

}  // namespace

Parameters read_parameters(const fs::path& file) {
  const std::string name = file.string(), extension = file.extension().string();
  Parameters parameters;
  if (extension == ".json")
    parameters = parse_parameters_json(read_whole(file), name);
  else if (extension == ".mmg3d")
    parameters = parse_parameters_mmg3d(read_whole(file), name);
  else
    throw InputError(fmt::format(
        "{}: no format of parameters is known by the extension '{}' (known: .json, .mmg3d)", name,
        extension));
  check_together(parameters, name);
  return parameters;
}

}  // namespace cavea::program
