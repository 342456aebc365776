#pragma once
#include <functional>
#include <span>

#include "cavea/mesh/mesh_data.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// The share of edge (a, b) at which the function takes the isovalue, by bisection: safe for any
/// function that changes its side. \param at_a, at_b its values at the ends less the isovalue, of
/// which one is negative, the other not
double zero_on_edge(const std::function<double(const Vec3&)>& function, double isovalue,
                    const Vec3& a, const Vec3& b, double at_a, double at_b);

/// Adds the function's gradient, by central differences, as normals of the vertices on the
/// interface. \param mesh with the vertices of `data`
void add_normals(const std::function<double(const Vec3&)>& function, const TetMesh& mesh,
                 std::span<const char> on_interface, MeshData& data);

}  // namespace cavea
