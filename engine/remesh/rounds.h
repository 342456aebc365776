#pragma once
#include <vector>

#include "cavea/remesh/job.h"
#include "cavea/remesh/recipe.h"

namespace cavea {

/// Runs the rounds of a phase until little changes. \throw Cancelled, MemoryError
void run_phase(Job& job, const Phase& phase);

/// Asks what the interfaces of the last phase's last round have blocked.
void run_residual_of(Job& job, const Phase& last);

/// Phase after phase, and what they have blocked.
void run_phases(Job& job, const std::vector<Phase>& phases);

}  // namespace cavea
