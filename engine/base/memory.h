#pragma once
#include <cstdint>

namespace cavea {

/// Largest resident set of this process so far, in bytes; 0 where the system does not tell.
std::int64_t peak_resident_bytes();

/// Memory that this process may use, in bytes: the machine's, or what its control group grants if
/// that is less. The largest number where the system does not tell.
std::int64_t usable_bytes();

}  // namespace cavea
