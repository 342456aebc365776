#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "cavea/base/ids.h"
#include "cavea/geometry/box_tree.h"
#include "cavea/geometry/point_block.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// The place of a Bezier triangle nearest to a point.
struct NearestOnPatch {
  double u = 0, v = 0;
  Vec3 point;
  double distance2 = std::numeric_limits<double>::infinity();
};

/// A place of the patch that is no farther from p than its places near (u, v): a constrained
/// Gauss-Newton search from there, each step to the place nearest to p on the tangent plane.
/// distance2 is that of a point of the patch, so never less than the patch's true distance.
NearestOnPatch closest_on_patch(const Vec3& p, const BezierTriangle& patch, double u, double v);

/// No place of the patch is farther from its flat facet: the largest distance of a control point,
/// since a patch is in their hull and the distance from a convex set is a convex function.
double bulge_bound(const BezierTriangle& patch);

/// No place of the patch is farther from its flat facet's place of the same coordinates: the
/// largest distance of a control point from where it is on a flat patch, of which the patch's
/// places are means. So it bounds the distance of the facet from its patch, too.
double offset_bound(const BezierTriangle& patch);

/// The place of a SurfaceModel nearest to a point.
struct NearestOnModel {
  NearestOnPatch place;
  std::int32_t facet = kNone;  ///< whose patch it is on; none on an empty model
  std::int32_t slot = kNone;   ///< the tree's own number of the facet, a hint for the next query
};

/// The nearest place of a whole SurfaceModel, over all its patches: what SurfaceModel::place()
/// finds by walking from a hint, but sure to find it. Read-only after construction: many threads
/// may ask at once. The model must outlive it.
class PatchTree {
 public:
  explicit PatchTree(const SurfaceModel& model);

  /// The place nearest to p. `hint`, found for another point, makes it sooner where it is near to p
  /// too. \param small any place of the hint's patch that is so near will do
  NearestOnModel nearest(const Vec3& p, const NearestOnModel& hint = {}, double small = -1) const;

  /// Slots of the facets of which a place may be in a box, or nearer to it than `reach`.
  void near(const Box& box, double reach, std::vector<std::int32_t>& slots) const;

  /// Sees which points of a block are near to a facet's patch: bounds of the distances of what
  /// search would find, little above them where the patch bulges little. \param box of the points
  void improve(const PointBlock& points, const Box& box, std::int32_t slot,
               NearestOfBlock& nearest) const;
  std::int32_t facet(std::int32_t slot) const { return tree_.order()[std::size_t(slot)]; }

  /// A hint where the place is thought to be on or near the facet; none where there is no such
  /// facet.
  NearestOnModel hint_at(std::int32_t facet) const;

 private:
  struct Leaf {
    std::array<Vec3, 3> corner;
    double bulge;  ///< no place of the patch is farther from the flat facet

    /// Whether a place of the patch may be so near to the box; false if surely none is.
    bool is_within(double reach, const Box& box) const;
  };
  const BezierTriangle& patch(std::size_t slot) const {
    return model_.patch_of_facet(tree_.order()[slot]);
  }

  const SurfaceModel& model_;
  BoxTree tree_;
  std::vector<Leaf> leaves_;  ///< in the order of the slots
  std::vector<std::int32_t> slots_;
};

}  // namespace cavea
