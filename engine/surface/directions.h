#pragma once
#include "cavea/mesh/mesh_data.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// Normals and tangents of the ideal surface at a mesh's vertices: unit vectors, and which vertex
/// has which, as in MeshData.
struct SurfaceDirections {
  std::vector<Vec3> normals;
  std::vector<std::array<std::int32_t, 2>> normal_at_vertices;
  std::vector<Vec3> tangents;
  std::vector<std::array<std::int32_t, 2>> tangent_at_vertices;
};

/// A normal at each surface vertex where the surface has one alone (at no corner, ridge,
/// non-manifold edge or place where the volume touches itself): out of the volume, of an interface
/// out of its smaller reference. A tangent at each vertex of a feature curve but at corners. The
/// same kinds of vertices have them in the files of mmg3d.
/// \pre the mesh has no holes, and the anchors are on `surface`
SurfaceDirections surface_directions(const TetMesh& mesh, const SurfaceModel& surface);

/// Puts them into the lists of the same mesh.
void add_directions(SurfaceDirections&& directions, MeshData& data);

}  // namespace cavea
