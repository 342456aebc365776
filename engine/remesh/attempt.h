#pragma once
// Of steps that are tried for the sake of a few tets: what is taken back, by which standard, and
// where they have failed.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "cavea/remesh/job.h"
#include "cavea/surface/crossings.h"
#include "cavea/surface/distance.h"

namespace cavea {

/// A place where an attempt has made something worse.
struct FailedPlace {
  Vec3 center;
  double radius = 0;

  bool contains(const Vec3& p) const { return distance2(center, p) <= radius * radius; }
};

/// What an attempt changes of a job, as it was before.
class Before {
 public:
  explicit Before(const Job& job);

  void give_back(Job& job) &&;

 private:
  TetMesh mesh_;
  std::vector<std::int32_t> part_of_tet_;
  ResidualCount residual_;
  VerdictTable verdicts_;
};

/// What a mesh must not fall short of after an attempt.
struct Standard {
  double farthest = 0;  ///< distance of the surface from the ideal one, in hausd
  double worst = 0;     ///< quality
  std::size_t crossings = 0;

  bool is_met(const TetMesh& mesh, const SurfaceDistance& distance,
              const std::vector<Crossing>& found) const;
  /// The places that must not be as they are: too far from the ideal surface, where the surface
  /// passes through itself, or among tets that are worse than any was.
  std::vector<FailedPlace> failures(const TetMesh& mesh, const SurfaceDistance& distance,
                                    const std::vector<Crossing>& found) const;
};

/// No worse than the mesh is, but as far from the ideal surface as results may be.
/// \param crossings of its surface
Standard standard_of(const TetMesh& mesh, const SurfaceDistance& distance, std::size_t crossings);

/// Tets below a quality, the worst first.
std::vector<TetId> tets_below(const TetMesh& mesh, double quality);
/// Those below kSoundQuality.
std::vector<TetId> unsound_tets(const TetMesh& mesh);

}  // namespace cavea
