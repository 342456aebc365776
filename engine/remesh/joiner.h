#pragma once
#include <cstdint>
#include <functional>
#include <optional>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "cavea/cavity/mesh_editor.h"
#include "cavea/remesh/attempt.h"
#include "cavea/remesh/job.h"
#include "cavea/remesh/junctions.h"

namespace cavea {

/// Joins parts of the surface at tets that are not sound, the worst first: few, one after the
/// other. The mesh may have holes then.
class Joiner {
 public:
  /// \param failed where less of the tolerance is to be used; must outlive the joiner
  Joiner(Job& job, const std::vector<FailedPlace>& failed);

  /// \param before_first is called before the mesh changes, if it does \return how many joined
  std::int64_t run(const std::function<void()>& before_first);

 private:
  struct Candidate {
    Cavity cavity;
    std::tuple<bool, int, float> rank;  ///< the lower, the better
    double moved = 0;
  };

  bool join_at(TetId t);
  void add_candidates(const std::vector<Junction>& junctions, int kind,
                      std::vector<Candidate>& found);
  bool has_interface(const Cavity& cavity) const;
  bool keeps_planes(const Cavity& cavity) const;
  double share_at(const Vec3& place) const;
  std::optional<double> displacement(const Junction& junction) const;
  bool crosses(const Cavity& cavity) const;
  void commit(const Candidate& candidate);

  Job& job_;
  const std::vector<FailedPlace>& failed_;
  TetMesh& mesh_;
  OperatorContext context_;
  MeshEditor editor_;
  std::function<void()> before_first_;
  std::unordered_map<VertexId, double> moved_;  ///< how far what meets there has been moved
  std::int64_t joined_ = 0;
};

}  // namespace cavea
