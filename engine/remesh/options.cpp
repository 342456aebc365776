#include "cavea/remesh/options.h"

#include <fmt/format.h>

#include <algorithm>
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

const char* name(LocalParameters::Entity entity) {
  return entity == LocalParameters::Entity::kTets ? "tetrahedra" : "triangles";
}

/// Every vertex of the region's own bounds is a number, and they are the right way around.
void check_shape(const SizeBox& box) {
  const Vec3 side = box.high - box.low;
  if (!(is_finite(box.low) && is_finite(box.high) && side.x > 0 && side.y > 0 && side.z > 0))
    throw OptionError("a box must have its low corner below its high one along each axis");
}

void check_shape(const SizeSphere& sphere) {
  if (!is_finite(sphere.center)) throw OptionError("the center of a sphere is not finite");
  require_positive(sphere.radius, "the radius of a sphere");
}

void check_all_local(const Options& o) {
  for (std::size_t i = 0; i < o.local.size(); ++i) {
    const LocalParameters& p = o.local[i];
    validate_entry(p);
    for (std::size_t j = 0; j < i; ++j)
      if (o.local[j].entity == p.entity && o.local[j].reference == p.reference)
        throw OptionError(fmt::format("there are two local parameters of {} of reference {}",
                                      name(p.entity), p.reference));
  }
  for (const SizeRegion& region : o.size_regions) {
    validate_entry(region);
    if (o.hmin && size_of(region) < *o.hmin)
      throw OptionError(
          fmt::format("the size {} of a region is smaller than hmin {}", size_of(region), *o.hmin));
  }
  if (o.hsiz && !(o.local.empty() && o.size_regions.empty()))
    throw OptionError("hsiz excludes local parameters and regions");
}

/// What the local parameters change of a run.
void resolve_local(const Options& o, ResolvedOptions& r) {
  r.local = o.local;
  r.smallest = r.hmin, r.largest = r.hmax;
  for (const LocalParameters& p : o.local) {
    r.smallest = std::min({r.smallest, p.hmin.value_or(r.hmin), p.hmax.value_or(r.hmax)});
    r.largest = std::max(r.largest, p.hmax.value_or(r.hmax));
    if (p.hausd) r.hausd_of_triangles.push_back({p.reference, *p.hausd});
  }
}

}  // namespace

void validate_entry(const LocalParameters& p) {
  require_positive(p.hmin, "hmin");
  require_positive(p.hmax, "hmax");
  require_positive(p.hausd, "hausd");
  if (p.hmin && p.hmax && *p.hmin > *p.hmax)
    throw OptionError(fmt::format("hmin {} is larger than hmax {}, of {} of reference {}", *p.hmin,
                                  *p.hmax, name(p.entity), p.reference));
  if (p.hausd && p.entity == LocalParameters::Entity::kTets)
    throw OptionError(
        fmt::format("hausd is of triangles, not of tetrahedra (reference {})", p.reference));
  if (!p.hmin && !p.hmax && !p.hausd)
    throw OptionError(
        fmt::format("{} of reference {} have no parameter", name(p.entity), p.reference));
}

void validate_entry(const SizeRegion& region) {
  std::visit([](const auto& r) { check_shape(r); }, region);
  require_positive(size_of(region), "the size of a region");
}

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
  check_all_local(o);
  if (o.hsiz && o.optim) throw OptionError("optim excludes hsiz");
  require_ratio(o.hgrad, "hgrad");
  require_ratio(o.hgradreq, "hgradreq");
  if (o.max_tets && *o.max_tets < 1)
    throw OptionError(fmt::format("max_tets must be at least 1, not {}", *o.max_tets));
  if (o.max_memory && *o.max_memory < 1)
    throw OptionError(fmt::format("max_memory must be at least 1 byte, not {}", *o.max_memory));
  require_range(o.angle, 0, 180, "angle");
  require_range(o.min_quality, 0, 1, "min_quality");
  require_range(o.min_conform, 0, 100, "min_conform");
  constexpr std::int64_t kFewestInPart = 100;  // of fewer nearly all are interface
  if (o.tets_per_part != 0 && o.tets_per_part < kFewestInPart)
    throw OptionError(
        fmt::format("tets_per_part must be at least {}, not {}", kFewestInPart, o.tets_per_part));
  if (o.threads < 0)
    throw OptionError(fmt::format("threads must be at least 1, not {}", o.threads));
}

ResolvedOptions resolve(const Options& o, const Extent& extent, const SizeRange& wished) {
  // Shares of the box diagonal, so that defaults need no knowledge of the mesh's scale.
  constexpr double kHausd = 0.001, kHmin = 0.001, kHmax = 0.1;
  // A wire or a sheet 1000 times as long as thick would have no shape within that tolerance: of
  // such bodies it is at most 0.08 of the thickness, and the shortest edge likewise.
  constexpr double kSlender = 80;
  const double length = std::min(extent.diagonal, kSlender * extent.thickness);
  ResolvedOptions r;
  r.hausd = o.hausd.value_or(kHausd * length);
  // A coarse input is thus rounded, not blown up; a surface that is to stay is the truth itself.
  constexpr double kBulges = 3;
  r.max_bulge = o.faceted || o.freeze.surface ? 0 : o.max_bulge.value_or(kBulges * r.hausd);
  r.hgrad = o.hgrad.value_or(std::numeric_limits<double>::infinity());
  r.hgradreq = o.hgradreq;
  r.freeze = o.freeze;
  // Grains, inclusions and balls leave places as narrow as 0.05 of a size that suits all else.
  constexpr double kFinest = 0.03;
  if (o.hsiz) {
    r.hmin = r.hmax = r.smallest = r.largest = *o.hsiz;
    r.finest = kFinest * r.smallest;
    return r;
  }
  // No edge is longer than the diagonal, whatever a field says where it means "any".
  const double largest = std::min(wished.largest, extent.diagonal);
  r.hmax = o.hmax.value_or(std::max({kHmax * extent.diagonal, largest, o.hmin.value_or(0)}));
  double smallest = std::min(kHmin * length, wished.smallest);
  for (const SizeRegion& region : o.size_regions) smallest = std::min(smallest, size_of(region));
  r.hmin = o.hmin.value_or(std::min(smallest, r.hmax));
  resolve_local(o, r);
  r.finest = o.hmin && !r.uniform() ? r.smallest : kFinest * r.smallest;
  return r;
}

}  // namespace cavea
