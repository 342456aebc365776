#include "cavea/base/parallel.h"

#include <tbb/info.h>

namespace cavea {

int default_threads() { return tbb::info::default_concurrency(); }

}  // namespace cavea
