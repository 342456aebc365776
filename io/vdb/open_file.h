#pragma once
// For the sources that include OpenVDB, not for others.
#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <exception>
#include <filesystem>

#include "cavea/base/error.h"

namespace cavea {

/// Calls f, once OpenVDB is ready, and turns what it throws about a file into our own error, which
/// says what `failed`: "cannot be read".
template <class OurError, class F>
auto with_openvdb_errors(const std::filesystem::path& file, const char* failed, F&& f) {
  try {
    openvdb::initialize();
    return f();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& e) {  // its own ones, and those of streams and memory
    throw OurError(fmt::format("{}: {}: {}", file.string(), failed, e.what()));
  }
}

}  // namespace cavea
