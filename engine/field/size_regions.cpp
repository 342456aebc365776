#include "cavea/field/size_regions.h"

#include <algorithm>
#include <cmath>

namespace cavea {
namespace {

/// Even without gradation a size rises no faster around its region: at a distance d it is then d
/// larger, so that a tet with the region inside has edges longer than their sizes, and is divided.
constexpr double kSteepest = 1;

double distance_from(const SizeBox& box, const Vec3& p) {
  const auto outside = [](double x, double low, double high) {
    return std::max({low - x, 0.0, x - high});
  };
  return norm({outside(p.x, box.low.x, box.high.x), outside(p.y, box.low.y, box.high.y),
               outside(p.z, box.low.z, box.high.z)});
}

double distance_from(const SizeSphere& sphere, const Vec3& p) {
  return std::max(0.0, distance(p, sphere.center) - sphere.radius);
}

}  // namespace

double size_of(const SizeRegion& region) {
  return std::visit([](const auto& r) { return r.size; }, region);
}

SizeField with_regions(SizeField field, std::vector<SizeRegion> regions, double hgrad) {
  if (regions.empty()) return field;
  const double slope = std::min(std::log(hgrad), kSteepest);
  return [=, field = std::move(field), regions = std::move(regions)](const Vec3& p) {
    double size = field ? field(p) : std::numeric_limits<double>::infinity();
    for (const SizeRegion& region : regions) {
      const double away = std::visit([&](const auto& r) { return distance_from(r, p); }, region);
      const double here = size_of(region) + slope * away;
      if (here < size) size = here;  // a size that is none stays one, to be refused
    }
    return size;
  };
}

}  // namespace cavea
