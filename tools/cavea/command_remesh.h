#pragma once
#include "heap.h"
#include "remesh_arguments.h"

namespace cavea::program {

/// Reads, remeshes, writes, reports. \return the exit status; \throw what the library throws
/// \param heap is told how large the mesh is
int run_remesh(const RemeshArguments& arguments, Heap& heap);

}  // namespace cavea::program
