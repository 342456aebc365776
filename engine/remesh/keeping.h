#pragma once
#include <cstdint>
#include <optional>

#include "cavea/mesh/statistics.h"

namespace cavea {

struct Job;

/// What of its input a run keeps.
struct Keeping {
  bool possible = false;   ///< the surface and number of tets are those wanted, operators are free
  bool stands = false;     ///< all is kept, but for poor tets
  std::int64_t poor = 0;   ///< so many of these are asked
  bool made_room = false;  ///< the input may be a result for which the sizes were made finer
  /// In the sizes that the input has, if it may be a result.
  std::optional<LengthStatistics> own_lengths;

  bool leaves_all() const { return stands && poor == 0; }
};

/// An input that stands is only mended in places if all but a few of its tets are as good as those
/// of results, or in any case; or not even that.
enum class Effort { kWhereNeeded, kMend, kLeave };

/// Whether the input is what is asked for, but for places: then those alone are asked, so that
/// remeshing a result changes next to nothing. \pre the job is analysed
Keeping keep_what_stands(Job& job, Effort effort);

}  // namespace cavea
