#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cavea/mesh/statistics.h"
#include "cavea/part/interface_quality.h"
#include "cavea/part/residual.h"
#include "cavea/surface/directions.h"

namespace cavea {

/// Why operators accepted or refused, summed over all parts.
struct VerdictCount {
  std::string op;       ///< "edge_split", "edge_collapse", ...
  std::string verdict;  ///< "accept", "inverted", "worse_quality", ...
  std::int64_t count = 0;
};

struct PhaseTime {
  std::string phase;
  double seconds = 0;
};

/// A goal of the run, and whether it was met.
struct Target {
  /// "worst quality", "flat tetrahedra", "conforming lengths", "tets", "surface distance" or
  /// "surface crossings"
  std::string name;
  double wanted = 0, measured = 0;
  bool met = true;
  std::string where;  ///< place of the worst offender, when missed
};

/// A tet that has stayed bad, and why.
struct StubbornTet {
  Vec3 where;  ///< its centroid
  double quality = 0;
  /// What each operator says to its six edges (a collapse both ways), four faces, four vertices.
  std::vector<VerdictCount> verdicts;
  std::string reason;  ///< what about the domain forbids better; empty if nothing is known
};

struct MeshSummary {
  Counts counts;
  QualityStatistics quality;
  LengthStatistics lengths;
};

/// What remesh() did and how good the result is.
struct Report {
  int threads = 0;
  double hausd = 0, hmin = 0, hmax = 0, hgrad = 0;  ///< as resolved; hgrad infinite if unbounded
  /// The share of the sizes asked for that was used, as elements of these had no room; mostly 1,
  /// and where nothing was changed.
  double finer = 1;
  MeshSummary before, after;  ///< before.lengths is empty (edges 0) when sizes were not yet known
  std::vector<PhaseTime> phases;
  double seconds = 0;
  double tets_per_second = 0;  ///< final tets over seconds
  std::int64_t peak_resident_bytes = 0;
  std::vector<VerdictCount> verdicts;
  int parts = 0;  ///< most parts of a round
  ResidualCount residual;
  InterfaceQuality interface_quality;
  double surface_distance = 0;  ///< two-sided, sampled, to the surface model
  double bulge = 0;  ///< largest distance of the surface model from the input's triangles
  std::vector<Target> targets;
  /// The tets below a quality of 0.3, or else the 20 worst below the target; at most 1000.
  std::vector<StubbornTet> stubborn;
  std::vector<std::string> warnings;      ///< of the input
  std::vector<std::int32_t> part_of_tet;  ///< of the last parallel round, by output tet

  SurfaceDirections directions;  ///< by output vertex, if options.directions asks for them

  bool targets_met() const {
    for (const Target& t : targets)
      if (!t.met) return false;
    return true;
  }
};

}  // namespace cavea
