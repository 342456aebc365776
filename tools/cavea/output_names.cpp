#include "output_names.h"

#include <fmt/format.h>

#include "cavea/base/error.h"
#include "cavea/io/formats.h"
#include "staging.h"

namespace cavea::program {
namespace {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;  // one of the two may not exist: then only their names can be compared
  if (fs::equivalent(a, b, ignored)) return true;
  // A relative name of which no part exists would stay as it is: hence absolute().
  return fs::weakly_canonical(fs::absolute(a), ignored) ==
         fs::weakly_canonical(fs::absolute(b), ignored);
}

void check_place(const NamedFile& file) {
  std::error_code error;
  const fs::file_status status = fs::status(file.path, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
    throw OptionError(
        fmt::format("{} {}: exists and is no regular file", file.role, file.path.string()));
  try {
    StagingDirectory{file.path};  // made and removed again: the only test that cannot be wrong
  } catch (const OutputError& e) {
    throw OptionError(fmt::format("{} {}: {}", file.role, file.path.string(), e.what()));
  }
}

}  // namespace

void check_outputs(const std::vector<NamedFile>& inputs, const std::vector<NamedFile>& outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& file = outputs[i];
    if (file.path.filename().empty())
      throw OptionError(fmt::format("{} '{}' names no file", file.role, file.path.string()));
    for (const NamedFile& input : inputs)
      if (same_file(file.path, input.path))
        throw OptionError(fmt::format("{} {} is {}", file.role, file.path.string(), input.role));
    for (std::size_t j = 0; j < i; ++j)
      if (same_file(file.path, outputs[j].path))
        throw OptionError(fmt::format("{} {} and {} {} are the same file", outputs[j].role,
                                      outputs[j].path.string(), file.role, file.path.string()));
    check_place(file);
  }
}

fs::path sizes_beside(const fs::path& mesh) {
  for (const FormatInfo& format : formats())
    if (mesh.extension() == format.extension && !format.sizes_extension.empty())
      return fs::path(mesh).replace_extension(format.sizes_extension);
  return {};
}

std::vector<NamedFile> files_of_mesh(const fs::path& name) {
  if (!is_writable_format(name))
    throw OptionError(fmt::format("-o {}: no format to write is known by the extension '{}'",
                                  name.string(), name.extension().string()));
  std::vector<NamedFile> files = {{"-o", name}};
  const fs::path sizes = sizes_beside(name);
  if (!sizes.empty()) files.push_back({"the sizes beside -o", sizes});
  return files;
}

}  // namespace cavea::program
