#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Upper ends of the length histogram's bins but the last (the bins that mmg prints).
inline constexpr std::array<double, 8> kLengthBins = {0.3, 0.6,        0.70710678, 0.9,
                                                      1.3, 1.41421356, 2,          5};

/// A tet of no volume, or of next to none.
struct FlatTet {
  TetId tet = kNone;
  Vec3 place;  ///< centroid
};

struct QualityStatistics {
  double worst = 0, mean = 0;
  TetId worst_tet = kNone;
  Vec3 worst_place;                          ///< centroid of the worst tet
  std::vector<FlatTet> flat;                 ///< of quality at or below kFlat, by rising id
  std::array<std::int64_t, 10> histogram{};  ///< ten bins from 0 to 1; below 0 counts as 0
  double smallest_dihedral = 0, largest_dihedral = 0;  ///< degrees
  std::array<std::int64_t, 18>
      dihedral_histogram{};  ///< all six angles of each tet, 10 degrees a bin
};

struct LengthStatistics {
  std::int64_t edges = 0;
  double shortest = 0, longest = 0, mean = 0;
  Vec3 longest_place;
  std::int64_t conforming = 0;              ///< within [1/sqrt2, sqrt2]
  std::array<std::int64_t, 9> histogram{};  ///< by kLengthBins
  double conforming_percent() const {
    return edges ? 100.0 * double(conforming) / double(edges) : 100;
  }
  /// Beyond sqrt2, which is the end of a bin.
  double too_long_percent() const {
    return edges ? 100.0 * double(histogram[6] + histogram[7] + histogram[8]) / double(edges) : 0;
  }
};

struct Counts {
  std::int64_t vertices = 0, tets = 0, triangles = 0;
  std::int64_t ridges = 0, corners = 0, required_vertices = 0;  ///< ridges counts edges
  std::int64_t components = 0;                                  ///< of the volume, through faces
  std::int64_t boundary_components = 0;  ///< of the exterior surface, through edges
  std::map<std::int32_t, std::int64_t> tets_of_ref, triangles_of_ref;
  std::map<std::int32_t, double> volume_of_ref;
  double volume = 0;
  Vec3 box_min, box_max;
  double box_diagonal() const { return distance(box_min, box_max); }
};

/// All of these skip holes and give the same bits for any number of threads.
QualityStatistics quality_statistics(const TetMesh& mesh);
/// The mean of mesh.qualities; 0 without tets.
double mean_quality(const TetMesh& mesh);
/// Lengths in the metric of mesh.sizes, which must be positive at every vertex.
LengthStatistics length_statistics(const TetMesh& mesh);
Counts count(const TetMesh& mesh);

/// Diagonal of the bounding box of the living vertices.
double box_diagonal(const TetMesh& mesh);
/// Six volumes over the area of the exterior boundary: the diameter of a ball, 1.5 diameters of a
/// long rod, thrice the thickness of a sheet. \pre no holes
double thickness(const TetMesh& mesh);

}  // namespace cavea
