#pragma once
#include <cstdint>

namespace cavea {

/// Where counting starts for scatter(), which maps 0 to itself.
inline constexpr std::uint64_t kScatterStart = 0x9e3779b97f4a7c15u;

/// A bijection of 64 bits after which numbers that followed each other look random (the finisher of
/// splitmix64).
inline std::uint64_t scatter(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace cavea
