#include "cavea/remesh/steps.h"

#include "cavea/base/cancel.h"

namespace cavea {

void Steps::tell(const char* phase, int round) const {
  throw_if_cancelled(options_.cancel);
  if (options_.progress)
    options_.progress(
        {phase, round, std::int64_t(mesh_.tets.size()), wanted_, since_start_.seconds()});
}

}  // namespace cavea
