#include "cavea/remesh/options.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "cavea/base/error.h"
#include "cavea/remesh/resolved.h"

namespace cavea {
namespace {

void require_positive(const std::optional<double>& value, const char* name) {
  if (value && !(std::isfinite(*value) && *value > 0))
    throw OptionError(fmt::format("{} must be a positive number, not {}", name, *value));
}

void require_ratio(const std::optional<double>& value, const char* name) {
  if (value && !(std::isfinite(*value) && *value >= 1))
    throw OptionError(fmt::format("{} must be a number of at least 1, not {}", name, *value));
}

void require_range(double value, double low, double high, const char* name) {
  if (!(value >= low && value <= high))
    throw OptionError(fmt::format("{} must be between {} and {}, not {}", name, low, high, value));
}

}  // namespace

void validate(const Options& o) {
  require_positive(o.hausd, "hausd");
  if (o.max_bulge && !(std::isfinite(*o.max_bulge) && *o.max_bulge >= 0))
    throw OptionError(
        fmt::format("max_bulge must be a number of at least 0, not {}", *o.max_bulge));
  if (o.faceted && o.max_bulge) throw OptionError("faceted excludes max_bulge");
  require_positive(o.hmin, "hmin");
  require_positive(o.hmax, "hmax");
  require_positive(o.hsiz, "hsiz");
  if (o.hsiz && (o.hmin || o.hmax)) throw OptionError("hsiz excludes hmin and hmax");
  if (o.hmin && o.hmax && *o.hmin > *o.hmax)
    throw OptionError(fmt::format("hmin {} is larger than hmax {}", *o.hmin, *o.hmax));
  if (o.hsiz && o.optim) throw OptionError("optim excludes hsiz");
  require_ratio(o.hgrad, "hgrad");
  require_ratio(o.hgradreq, "hgradreq");
  if (o.max_tets && *o.max_tets < 1)
    throw OptionError(fmt::format("max_tets must be at least 1, not {}", *o.max_tets));
  require_range(o.angle, 0, 180, "angle");
  require_range(o.min_quality, 0, 1, "min_quality");
  require_range(o.min_conform, 0, 100, "min_conform");
  if (o.threads < 0)
    throw OptionError(fmt::format("threads must be at least 1, not {}", o.threads));
}

ResolvedOptions resolve(const Options& o, double box_diagonal, const SizeRange& wished) {
  // Shares of the box diagonal, so that defaults need no knowledge of the mesh's scale.
  constexpr double kHausd = 0.001, kHmin = 0.001, kHmax = 0.1;
  ResolvedOptions r;
  r.hausd = o.hausd.value_or(kHausd * box_diagonal);
  // A coarse input is thus rounded, not blown up; a surface that is to stay is the truth itself.
  constexpr double kBulges = 3;
  r.max_bulge = o.faceted || o.freeze.surface ? 0 : o.max_bulge.value_or(kBulges * r.hausd);
  r.hgrad = o.hgrad.value_or(std::numeric_limits<double>::infinity());
  r.hgradreq = o.hgradreq;
  r.freeze = o.freeze;
  if (o.hsiz) {
    r.hmin = r.hmax = *o.hsiz;
    return r;
  }
  // No edge is longer than the diagonal, whatever a field says where it means "any".
  const double largest = std::min(wished.largest, box_diagonal);
  r.hmax = o.hmax.value_or(std::max({kHmax * box_diagonal, largest, o.hmin.value_or(0)}));
  r.hmin = o.hmin.value_or(std::min({kHmin * box_diagonal, wished.smallest, r.hmax}));
  return r;
}

}  // namespace cavea
