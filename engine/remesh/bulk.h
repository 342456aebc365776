#pragma once
#include <atomic>
#include <functional>
#include <optional>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// The mesh without most of the vertices inside that are much nearer to each other than wanted,
/// level by level; nothing if they are not many.
std::optional<TetMesh> coarsened_in_bulk(const TetMesh& mesh,
                                         const std::atomic<bool>* cancel = nullptr);

enum class BulkEdges { kOfSurface, kAll };

/// Pattern subdivision, all at once and level by level, of the edges that are much longer than
/// wanted (paper, section 4.1.1), until few are left; `resize` sets the wanted sizes of a finer
/// mesh. Those of the surface if seed_interior() is to fill the volume; all where the body is too
/// thin for seeds. \return the mesh before, if it was refined
std::optional<TetMesh> refine_in_bulk(TetMesh& mesh, const SurfaceModel& surface, BulkEdges which,
                                      const std::function<void()>& resize);

}  // namespace cavea
