#pragma once
#include <cstdint>

namespace cavea {

/// Largest resident set of this process so far, in bytes; 0 where the system does not tell.
std::int64_t peak_resident_bytes();

}  // namespace cavea
