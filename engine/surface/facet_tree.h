#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cavea/base/ids.h"
#include "cavea/geometry/box_tree.h"
#include "cavea/geometry/point_block.h"

namespace cavea {

/// A triangle's three corners.
using Corners = std::array<Vec3, 3>;

/// The triangle of a FacetTree nearest to a point.
struct NearestFacet {
  std::int32_t facet = kNone;  ///< index into the triangles given to the tree; none if none is near
  double u = 0, v = 0;         ///< barycentric coordinates of its second and third corner
  double distance2 = std::numeric_limits<double>::infinity();
  std::int32_t slot = kNone;  ///< the tree's own number of it, for nearest_from()
};

/// The nearest of many flat triangles. Read-only after construction: many threads may ask at once.
class FacetTree {
 public:
  explicit FacetTree(std::span<const Corners> triangles);

  /// The triangle nearest to p; none if all are at least sqrt(bound2) away. Of several equally near
  /// ones, one that p, the bound and the triangles fix.
  NearestFacet nearest(const Vec3& p,
                       double bound2 = std::numeric_limits<double>::infinity()) const;

  /// The same without bound, sooner where `hint`, found for another point, is near to p too.
  /// \param small the hint's triangle will do if it is so near
  NearestFacet nearest_from(const Vec3& p, const NearestFacet& hint, double small = -1) const;

  /// The triangles nearest to the points of a block, where one is nearer than `reach`; where none
  /// is, one that need not be the nearest, or none.
  /// \param box of the points \param hint a triangle's slot, or none: that one alone will do if no
  /// point is farther from it than `small` \return whether the others have been looked at
  bool nearest(const PointBlock& points, const Box& box, std::int32_t hint, double reach,
               double small, NearestOfBlock& nearest) const;
  /// The triangle in a slot.
  std::int32_t triangle(std::int32_t slot) const { return tree_.order()[std::size_t(slot)]; }

  /// A hint where the place is thought to be on or near the triangle; none where that is kNone.
  NearestFacet hint_at(std::int32_t triangle) const;

 private:
  NearestFacet on(const Vec3& p, std::size_t slot) const;
  void improve(const Vec3& p, NearestFacet& best) const;

  BoxTree tree_;
  std::vector<Corners> triangles_;  ///< in the order of the slots
  std::vector<std::int32_t> slots_;
};

}  // namespace cavea
