#pragma once
#include <cstdint>

#include "cavea/remesh/job.h"

namespace cavea {

/// Phases end when little of the whole changes: what is poor then may be little of it, and is asked
/// for itself as long as that helps.
void mend_poor(Job& job);

/// Whether asking poor tets was in vain: too many of them have stayed so.
bool stays_poor(std::int64_t left, std::int64_t poor);

/// The same of a mesh whose poor tets another run may have mended before: in sizes that are a
/// little other, which a rerun finds, up to thrice the root of their number goes or comes by
/// chance, unless that is half of them.
bool mended_by_chance(std::int64_t left, std::int64_t poor);

}  // namespace cavea
