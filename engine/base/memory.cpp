#include "cavea/base/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace cavea {
namespace {

constexpr std::int64_t kUnknown = std::numeric_limits<std::int64_t>::max();
constexpr auto kWholeLine = std::numeric_limits<std::streamsize>::max();

std::int64_t machine_bytes() {
  const std::int64_t pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? pages * page : kUnknown;
}

/// The file says "max" where there is no bound.
std::int64_t number_in(const char* file) {
  std::int64_t bytes = 0;
  return std::ifstream(file) >> bytes && bytes > 0 ? bytes : kUnknown;
}

}  // namespace

std::int64_t peak_resident_bytes() {
  // What getrusage tells begins with the peak of the process that started this one.
  std::ifstream status("/proc/self/status");
  for (std::string name; status >> name; status.ignore(kWholeLine, '\n'))
    if (std::int64_t kib = 0; name == "VmHWM:" && status >> kib) return kib * 1024;
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
  return std::int64_t{usage.ru_maxrss} * 1024;  // Linux counts in KiB
}

std::int64_t usable_bytes() {
  return std::min({machine_bytes(), number_in("/sys/fs/cgroup/memory.max"),
                   number_in("/sys/fs/cgroup/memory/memory.limit_in_bytes")});  // of versions 2, 1
}

}  // namespace cavea
