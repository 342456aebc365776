#include "cavea/vdb/backend.h"

/// What the module is asked for.
extern "C" const cavea::VdbBackend cavea_vdb_backend = {cavea::openvdb_module::open_grid,
                                                        cavea::openvdb_module::write_sample_grid,
                                                        cavea::openvdb_module::write_surface_grid};
