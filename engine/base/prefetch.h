#pragma once

namespace cavea {

/// Asks for the memory at p, which is to be read or written soon, where the compiler can.
inline void prefetch([[maybe_unused]] const void* p) {
#if defined(__GNUC__)
  __builtin_prefetch(p);
#endif
}

}  // namespace cavea
