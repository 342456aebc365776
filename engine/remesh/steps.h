#pragma once
#include <cstdint>
#include <vector>

#include "cavea/base/timer.h"
#include "cavea/mesh/tet_mesh.h"
#include "cavea/remesh/options.h"
#include "cavea/remesh/report.h"

namespace cavea {

/// Times the steps of a run and tells the caller how far it is.
class Steps {
 public:
  /// \param mesh that is worked on \param times gets the time of each step
  Steps(const TetMesh& mesh, const Options& options, std::vector<PhaseTime>& times)
      : mesh_(mesh), options_(options), times_(times) {}

  template <class Step>
  void timed(const char* name, Step&& step) {
    Timer timer;
    tell(name, 0);
    step();
    times_.push_back({name, timer.seconds()});
  }

  /// From now on the caller is told that there will be about so many tets.
  void expect(double tets) { wanted_ = std::int64_t(tets); }

  /// \throw Cancelled if the caller wants no more
  void tell(const char* phase, int round) const;

 private:
  const TetMesh& mesh_;
  const Options& options_;
  std::vector<PhaseTime>& times_;
  std::int64_t wanted_ = 0;
  Timer since_start_;
};

}  // namespace cavea
