#pragma once
#include <string>

#include "cavea/remesh/options.h"

namespace cavea::program {

/// Shows the state of a run on standard error: one line that is rewritten if that is a terminal,
/// else a line for each phase.
class ProgressPrinter {
 public:
  ProgressPrinter();
  /// Takes the line away, so that what follows starts on a clean one.
  ~ProgressPrinter();
  ProgressPrinter(const ProgressPrinter&) = delete;
  ProgressPrinter& operator=(const ProgressPrinter&) = delete;

  void show(const Progress& progress);

 private:
  bool terminal_;
  bool line_open_ = false;
  std::string phase_;
  double shown_at_ = 0;  ///< seconds of the run
};

}  // namespace cavea::program
