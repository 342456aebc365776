#pragma once

namespace cavea::program {

/// What the program's exit status tells a script. A run stopped by a signal ends with 128 plus the
/// signal's number, and writes nothing.
enum ExitStatus : int {
  kDone = 0,      ///< all was done and every target met; info: the mesh is sound
  kMissed = 1,    ///< a valid mesh was written that misses a target; info: the mesh is not sound
  kBadInput = 2,  ///< the command line or the input is at fault; nothing was written
  kOurFault = 3,  ///< anything else; nothing was written
};

}  // namespace cavea::program
