#include "cavea/field/spots.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

#include "cavea/geometry/box_tree.h"

namespace cavea {
namespace {

std::vector<Box> boxes_around(const std::vector<SizeSphere>& spots) {
  std::vector<Box> boxes(spots.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const double r = spots[i].radius;
    boxes[i].add(spots[i].center + Vec3{r, r, r});
    boxes[i].add(spots[i].center - Vec3{r, r, r});
  }
  return boxes;
}

/// Shared by the copies of a field.
struct Spots {
  explicit Spots(std::vector<SizeSphere> some)
      : spots(std::move(some)), tree(boxes_around(spots)) {}
  std::vector<SizeSphere> spots;
  BoxTree tree;
};

}  // namespace

SizeField field_inside(std::vector<SizeSphere> spots) {
  return [all = std::make_shared<const Spots>(std::move(spots))](const Vec3& p) {
    double size = std::numeric_limits<double>::infinity();
    Box here;
    here.add(p);
    all->tree.visit_overlapping(here, [&](std::size_t slot) {
      const SizeSphere& s = all->spots[std::size_t(all->tree.order()[slot])];
      if (distance2(s.center, p) <= s.radius * s.radius) size = std::min(size, s.size);
    });
    return size;
  };
}

}  // namespace cavea
