#pragma once
#include "remesh_arguments.h"

namespace cavea::program {

/// Reads, remeshes, writes, reports. \return the exit status; \throw what the library throws
int run_remesh(const RemeshArguments& arguments);

}  // namespace cavea::program
