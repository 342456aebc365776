#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cavea/geometry/box.h"
#include "cavea/geometry/vec3.h"

namespace cavea {

/// How a grid is sampled and written.
struct GridSettings {
  int voxels = 128;       ///< along the longest side of the box
  double half_width = 3;  ///< of the band of active voxels, in voxels
  std::string name = "phi";
};

/// A function to sample in a box: negative inside, and of slopes of at most `steepest`.
struct SampleShape {
  std::function<double(const Vec3&)> value;
  Box box;
  double steepest = 1;
};

/// Writes a narrow band of a function's values as a level set of floats. Voxels' centres are at
/// whole multiples of the voxel's width; memory is proportional to the band. The file is the same
/// bytes at any number of threads.
/// \throw OptionError: fewer than 8 voxels or a half width below 2; OutputError
void write_sample_grid(const std::filesystem::path& file, const SampleShape& shape,
                       const GridSettings& settings);

/// A closed surface, counter-clockwise from outside.
struct SurfaceTriangles {
  std::vector<Vec3> points;
  std::vector<std::array<std::int32_t, 3>> triangles;
};

/// The same of the signed distance from a surface, through OpenVDB's meshToVolume.
void write_surface_grid(const std::filesystem::path& file, const SurfaceTriangles& surface,
                        const GridSettings& settings);

}  // namespace cavea
