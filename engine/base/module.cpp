#include "cavea/base/module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "cavea/base/error.h"

namespace cavea {
namespace {

namespace fs = std::filesystem;

/// Where our own build and installed programs have it, and what builds us as a part of itself.
/// Empty if it is in neither.
fs::path beside_the_program(const std::string& file) {
  std::error_code ignored;  // without /proc the dynamic loader has to find it
  const fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  for (const fs::path& root : {folder.parent_path(), folder})
    if (const fs::path path = root / "lib" / "cavea" / file; fs::exists(path, ignored)) return path;
  return {};
}

void* open_module(const std::string& module) {
  const std::string file = module + ".so";
  const fs::path beside = beside_the_program(file);
  return ::dlopen(beside.empty() ? file.c_str() : beside.c_str(), RTLD_NOW | RTLD_LOCAL);
}

}  // namespace

void* module_symbol(const std::string& module, const char* symbol) {
  void* const opened = open_module(module);
  void* const found = opened ? ::dlsym(opened, symbol) : nullptr;
  if (!found)
    throw OptionError(fmt::format("the module {} cannot be used: {}", module, ::dlerror()));
  return found;
}

}  // namespace cavea
