#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "cavea/geometry/box_tree.h"

namespace cavea {

/// The triangles of a surface as sheets that may come near each other: how far it is from one to
/// the next through space, not along the surface. Read-only after construction: many threads may
/// ask at once.
class Sheets {
 public:
  using Corners = std::array<Vec3, 3>;

  /// What stands opposite a triangle.
  struct Facing {
    double side = 1;            ///< 1: ahead, where its normal points; -1: behind
    double cone_cosine = 0;     ///< of the angle between that way and the one to it, at least
    double normals_cosine = 0;  ///< of the angle between the two normals, at most, whichever way
                                ///< those of two-sided triangles point
    bool touching = true;       ///< whether what touches counts, which is on neither side
  };
  static constexpr double kNothing = std::numeric_limits<double>::infinity();

  /// \param vertices three ids each: triangles with a common one are never opposite each other
  /// \param one_sided whether there is volume on one side of the triangle only, so that its normal
  /// tells where
  Sheets(std::vector<Corners> triangles, std::vector<std::array<std::int32_t, 3>> vertices,
         std::vector<char> one_sided);

  /// Squared distance of a place from the nearest triangle, however that faces; none less than
  /// `bound2` is `bound2`.
  double distance2(const Vec3& place, double bound2) const;

  /// Distance from a place on triangle t to the nearest sheet opposite; kNothing where that is not
  /// less than `reach`.
  double opposite(std::size_t t, const Vec3& place, const Facing& facing, double reach) const;

  /// The same for each triangle, from its corners and its centroid. What is opposite another
  /// triangle is as near to that one, whatever its own samples say. No reach, no question.
  std::vector<double> all_opposite(const Facing& facing,
                                   const std::function<double(std::size_t)>& reach) const;

 private:
  struct Hit {
    std::int32_t triangle = -1;
    double distance2 = kNothing;
  };
  /// Whether the normals of the two and their vertices allow that s is opposite t.
  bool may_face(std::size_t t, std::size_t s, const Facing& facing) const;
  /// Whether some triangle below a node of the tree may be opposite t, for all that is known of
  /// their normals.
  bool some_may_face(std::size_t t, std::size_t node, const Facing& facing) const;
  /// The same for all that is known of their places, too, as seen from a place, or a box of them,
  /// of t at `height` along its normal or more.
  template <class Place>
  bool some_may_be_opposite(std::size_t t, const Place& place, double height, std::size_t node,
                            const Facing& facing) const;
  /// Sees whether s is nearer to a place on t than what it has hit.
  void improve(std::size_t t, const Vec3& place, std::size_t s, const Facing& facing,
               Hit& hit) const;
  /// What is nearest to any of some places on t, all of them in `around`.
  template <class Place>
  Hit nearest(std::size_t t, const Place& around, std::span<const Vec3> places,
              const Facing& facing, double reach) const;
  Hit nearest_of_triangle(std::size_t t, const Facing& facing, double reach) const;
  bool apart(std::size_t s, std::size_t t) const;

  std::vector<Corners> triangles_;
  std::vector<std::array<std::int32_t, 3>> vertices_;
  std::vector<char> one_sided_;
  std::vector<Vec3> normals_;
  BoxTree tree_;
  double rounding2_ = 0;  ///< squared distance of sheets that touch
  /// Of all below each node, both ways for two-sided triangles.
  std::vector<Box> normals_of_node_;
};

}  // namespace cavea
