#pragma once
#include "cavea/remesh/options.h"
#include "cavea/remesh/report.h"

namespace cavea {

/// Where a body has no room, sizes of this share of those wanted are the finest that are tried.
inline constexpr double kFinestRoom = 0.21;

/// All bodies that are nowhere narrow reach this mean quality with the default gradation.
inline constexpr double kRoomyMean = 0.78;

/// How much room the shape leaves for elements of the sizes asked for: in strips one of them wide
/// all are of a poor quality, or few have the lengths wanted.
enum class Room { kMissing, kLittle, kEnough };

/// Whether the mesh is one with room, as far as the means tell.
bool has_room(const MeshSummary& after, const Options& options);

/// Whether another run might find that it has none.
bool hardly_has_room(const MeshSummary& after, const Options& options);

/// Whether the mesh is so coarse on the whole that it may grow many times to have room.
bool is_coarse_mesh(const MeshSummary& after);

/// Room is only looked for where the caller left the sizes to us.
Room room_in(const MeshSummary& after, const Options& options, bool has_field);

}  // namespace cavea
