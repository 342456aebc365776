#pragma once
#include <atomic>

#include "cavea/base/error.h"

namespace cavea {

/// \throw Cancelled if the caller has raised the flag, which may be none
inline void throw_if_cancelled(const std::atomic<bool>* cancel) {
  if (cancel && cancel->load(std::memory_order_relaxed)) throw Cancelled();
}

}  // namespace cavea
