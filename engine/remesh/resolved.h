#pragma once
#include "cavea/remesh/options.h"

namespace cavea {

/// The lengths of a run, all set.
struct ResolvedOptions {
  double hausd = 0, hmin = 0, hmax = 0, hgrad = 1;
  bool uniform() const { return hmin == hmax; }
};

/// \pre validate(options) passed; box_diagonal > 0
ResolvedOptions resolve(const Options& options, double box_diagonal);

}  // namespace cavea
