#pragma once
#include <cstddef>
#include <vector>

#include "cavea/geometry/vec3.h"

namespace cavea {

/// The faces opposite a common apex, as arrays for wide registers: what the qualities of a ball
/// need when its vertex is tried in many places. Gives the same bits on every instruction set.
class Star {
 public:
  void clear() { count_ = 0; }
  /// Adds a face, counter-clockwise seen from outside of the star.
  void add(const Vec3& a, const Vec3& b, const Vec3& c);
  /// Computes what does not depend on the apex, which wants edges of `size`; after the last add().
  void prepare(double size);

  std::size_t size() const { return count_; }

  /// tet_quality(apex, a, b, c) of each face, into qualities()[0 .. size()).
  void evaluate(const Vec3& apex);
  const double* qualities() const { return row(kQuality); }

  /// The apex that would make the tet on face i as regular as the face allows: over its centroid, at
  /// the height of a regular tet whose edges are between the face's and the wanted size. The face's first vertex where it has no area.
  Vec3 ideal_apex(std::size_t i) const;

 private:
  enum Row {
    kAx,
    kAy,
    kAz,
    kBx,
    kBy,
    kBz,
    kCx,
    kCy,
    kCz,
    kNx,
    kNy,
    kNz,
    kEdges,
    kQuality,
    kHx,
    kHy,
    kHz,
    kRows
  };
  double* row(Row r) { return data_.data() + std::size_t(r) * capacity_; }
  const double* row(Row r) const { return data_.data() + std::size_t(r) * capacity_; }
  void grow();

  std::size_t count_ = 0, capacity_ = 0;
  std::vector<double> data_;
};

}  // namespace cavea
