#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cavea/geometry/box.h"
#include "cavea/geometry/oriented_point.h"

namespace cavea {

struct GridSource;

/// Which grid of a file, and which of its level sets.
struct GridChoice {
  std::string name;  ///< empty: the only grid there is
  /// The inside is where values are smaller; of a fog volume, where they are larger. If not given,
  /// 0, and of a fog volume 0.5.
  std::optional<double> isovalue;
};

/// A scalar grid of an OpenVDB file as a level set in world coordinates, linear between voxels'
/// centres along each axis. Any number of threads may ask it at once.
class Grid {
 public:
  /// \throw InputError naming the file: not of OpenVDB, cut short, no grid of that name (names
  /// those there are), a grid that is not of floats or doubles, without active voxels, with a value
  /// that is not finite, or whose values are nowhere the isovalue (says their range)
  /// \throw OptionError if the isovalue is not finite, or this build is without OpenVDB
  Grid(const std::filesystem::path& file, const GridChoice& choice);
  Grid(Grid&&) noexcept;
  ~Grid();

  /// Negative inside, zero at the isovalue.
  double value(const Vec3& p) const;
  /// By central differences over a voxel's width, which the linear pieces' corners do not disturb.
  Vec3 gradient(const Vec3& p) const;

  /// Length of a voxel's shortest side.
  double voxel() const;
  /// Around the centres of the active voxels, and of a fog volume of those next to them.
  const Box& bounds() const;
  /// Whether the level set reaches the end of the active voxels: beyond it, values say nothing.
  bool is_open() const;
  /// Zeros everywhere on the level set, one in each block of two cells along each axis.
  const std::vector<OrientedPoint>& zeros() const;

 private:
  std::unique_ptr<const GridSource> source_;
};

}  // namespace cavea
