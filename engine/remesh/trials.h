#pragma once
#include "cavea/remesh/run.h"

namespace cavea {

/// Runs on one input until the result has room for its elements.
Result run_trials(Input& input, const SizeField& field, const Options& options);

}  // namespace cavea
