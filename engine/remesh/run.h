#pragma once
#include <utility>
#include <vector>

#include "cavea/remesh/job.h"
#include "cavea/remesh/keeping.h"
#include "cavea/remesh/recipe.h"

namespace cavea {

struct Result {
  TetMesh mesh;
  Report report;
};

/// One way from the input to a result.
class Run {
 public:
  /// \param finer the share that is used of sizes that are not given
  Run(Input& input, const SizeField& field, const Options& options,
      Effort effort = Effort::kWhereNeeded, double finer = 1);

  void operator()();

  /// From the sizes of this run to larger ones.
  void coarsen(double finer);

  /// Whether the input is what is asked for, but for places; nothing else is done.
  bool stands();

  bool only_mends() const { return job_.keeping.stands; }

  /// Whether the input may be a result for which the sizes were made finer.
  bool made_room() const { return job_.keeping.made_room; }

  /// Whether the input was as good as the result: it is then better left as it is.
  bool in_vain() const;

  /// Whether poor tets were asked, and stayed so: others in their places are no better.
  bool mended_in_vain() const;

  const TetMesh& mesh() const { return job_.mesh; }
  const Report& report() const { return job_.report; }

  /// The times since they were last taken.
  std::vector<PhaseTime> take_phases() { return std::exchange(job_.report.phases, {}); }
  Result take() { return {job_.loan.take(), std::move(job_.report)}; }

 private:
  void analyse();
  bool is_to_be_ordered() const;
  void adapt(const std::vector<Phase>& phases);

  Job job_;
  Effort effort_;
};

}  // namespace cavea
