#include "cavea/implicit/box_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cavea/base/error.h"

namespace cavea {
namespace {

// The cells are round figures near what was asked for: ids are far from their end.
constexpr double kMostCells = 1e8;

/// The corners of the cells, numbered row by row.
class Grid {
 public:
  Grid(const Box& box, double cells) : box_(box), side_(box.high - box.low) {
    if (!is_finite(side_) || !(side_.x > 0 && side_.y > 0 && side_.z > 0))
      throw OptionError(fmt::format("the box from ({}, {}, {}) to ({}, {}, {}) has no volume",
                                    box.low.x, box.low.y, box.low.z, box.high.x, box.high.y,
                                    box.high.z));
    if (!(cells >= 1 && cells <= kMostCells))
      throw OptionError(fmt::format("a box cannot have {} cells", cells));
    const double edge =
        std::cbrt(side_.x) * std::cbrt(side_.y) * std::cbrt(side_.z) / std::cbrt(cells);
    for (int k = 0; k < 3; ++k)
      count_[k] = std::int32_t(std::clamp(std::round(side_[k] / edge), 1.0, cells));
  }

  MeshData mesh() const {
    MeshData data;
    for (std::int32_t k = 0; k <= count_[2]; ++k)
      for (std::int32_t j = 0; j <= count_[1]; ++j)
        for (std::int32_t i = 0; i <= count_[0]; ++i) data.vertices.push_back(point({i, j, k}));
    for (std::int32_t k = 0; k < count_[2]; ++k)
      for (std::int32_t j = 0; j < count_[1]; ++j)
        for (std::int32_t i = 0; i < count_[0]; ++i) add_cell({i, j, k}, data.tets);
    data.vertex_refs.assign(data.vertices.size(), 0);
    data.tet_refs.assign(data.tets.size(), 1);
    for (int axis = 0; axis < 3; ++axis)
      for (int side = 0; side < 4; ++side) add_ridge(axis, side & 1, side >> 1, data);
    return data;
  }

 private:
  using Place = std::array<std::int32_t, 3>;

  /// Along an axis; the last one is the box's to the bit.
  double coordinate(const Place& p, int axis) const {
    if (p[axis] == count_[axis]) return box_.high[axis];
    return box_.low[axis] + side_[axis] * p[axis] / count_[axis];
  }
  Vec3 point(const Place& p) const {
    return {coordinate(p, 0), coordinate(p, 1), coordinate(p, 2)};
  }
  std::int32_t vertex(const Place& p) const {
    return (p[2] * (count_[1] + 1) + p[1]) * (count_[0] + 1) + p[0];
  }

  /// The tets go from the cell's first corner to its last along each order of the axes.
  void add_cell(const Place& first, std::vector<std::array<std::int32_t, 4>>& tets) const {
    constexpr int kAxes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (int p = 0; p < 6; ++p) {
      Place at = first;
      std::array<std::int32_t, 4> tet{vertex(at)};
      for (int step = 0; step < 3; ++step) {
        ++at[kAxes[p][step]];
        tet[step + 1] = vertex(at);
      }
      if (p >= 3) std::swap(tet[2], tet[3]);  // an odd order of the axes
      tets.push_back(tet);
    }
  }

  /// One of the four edges of the box along an axis: at the low or the high end of the other axes.
  void add_ridge(int axis, bool high_second, bool high_third, MeshData& data) const {
    Place at{};
    if (high_second) at[(axis + 1) % 3] = count_[(axis + 1) % 3];
    if (high_third) at[(axis + 2) % 3] = count_[(axis + 2) % 3];
    while (at[axis] < count_[axis]) {
      const std::int32_t first = vertex(at);
      ++at[axis];
      data.ridges.push_back(std::int32_t(data.edges.size()));
      data.edges.push_back({first, vertex(at)});
      data.edge_refs.push_back(0);
    }
  }

  Box box_;
  Vec3 side_;
  std::array<std::int32_t, 3> count_{};
};

}  // namespace

MeshData box_mesh(const Box& box, double cells) { return Grid(box, cells).mesh(); }

}  // namespace cavea
