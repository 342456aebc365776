#pragma once
#include "cavea/field/wanted_sizes.h"
#include "cavea/remesh/options.h"

namespace cavea {

/// The lengths of a run, all set.
struct ResolvedOptions {
  double hausd = 0, max_bulge = 0, hmin = 0, hmax = 0;
  /// The smallest and largest of all bounds, local ones too.
  double smallest = 0, largest = 0;
  /// What repairs may go down to where nothing else helps: the smallest, or less where that is not
  /// the caller's bound but a default, or a uniform size, which would forbid them.
  double finest = 0;
  std::vector<LocalParameters> local;
  std::vector<std::pair<std::int32_t, double>> hausd_of_triangles;  ///< by reference
  double hgrad = 1;                                                 ///< infinity for no bound
  std::optional<double> hgradreq;
  Freezes freeze;
  bool uniform() const { return smallest == largest; }
};

/// How large a body is: its box_diagonal() and its thickness().
struct Extent {
  double diagonal = 0, thickness = 0;  ///< positive
};

/// \param wished the sizes that the user's field asks for, between which a bound that is not set
/// does not come, nor above those of regions; empty if there is no field
/// \pre validate(options) passed
ResolvedOptions resolve(const Options& options, const Extent& extent, const SizeRange& wished = {});

}  // namespace cavea
