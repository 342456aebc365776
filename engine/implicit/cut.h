#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "cavea/implicit/level_set.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// What becomes of the tets of one reference.
struct CutMaterial {
  bool split = true;  ///< false: they keep their reference on both sides
  std::int32_t inside = 3, outside = 2;
};

enum class CutKeep { kBoth, kInside, kOutside };

/// How a mesh is cut along a level set. The default references are mmg's.
struct CutOptions {
  double isovalue = 0;  ///< the inside is where the values are smaller
  CutMaterial material;
  std::map<std::int32_t, CutMaterial> material_of_ref;  ///< of those that differ from `material`
  std::int32_t interface_ref = 10;                      ///< of the triangles on the level set
  CutKeep keep = CutKeep::kBoth;
  /// Components of the inside of less than this share of the whole volume become outside; after
  /// that those of the outside that do not reach the boundary of the domain become inside. In [0,1)
  double remove_components = 0;
};

/// What cutting did.
struct CutReport {
  double smallest_value = 0, largest_value = 0;
  std::int64_t vertices_on_interface = 0;  ///< those of the input that are
  std::int64_t interface_triangles = 0;
  std::int64_t removed_components = 0, filled_cavities = 0;
  bool open = false;  ///< the level set meets the boundary of the domain
  /// Of a function: how far its zero is from the interface's triangles, at most, to first order.
  double sagitta = 0;
  /// The max_bulge with which remesh()'s smooth surface reaches from the triangles to the zero: the
  /// control points of a cubic are a third farther off than itself.
  double needed_bulge() const { return 4 * sagitta / 3; }
};

struct CutResult {
  TetMesh mesh;
  CutReport report;
};

/// Cuts a mesh along the level set of values at its vertices (paper, section 5.1): every edge with
/// ends on both sides is split at the zero, all at once by conforming patterns, after which no tet
/// has vertices of both sides. The interface is closed and manifold but where it meets the boundary
/// of the domain. Surface triangles, features and references of the boundary stay.
/// \param values one a vertex of `mesh`
/// \pre mesh has no holes
/// \throw InputError naming the entity: another number of values, a value that is not finite, all
/// of them on one side (says the range), a required entity to be cut, nothing left to keep
/// \throw OptionError if remove_components is not in [0, 1) or the isovalue is not finite
CutResult cut_along(const TetMesh& mesh, std::span<const double> values,
                    const CutOptions& options = {});

/// The same for a function: cuts are at its own zeros (less the isovalue), and the surface has its
/// gradient's normals. Where the mesh is coarse, give remesh() the report's needed_bulge().
CutResult cut_along(const TetMesh& mesh, const LevelSet& level_set, const CutOptions& options = {});
CutResult cut_along(const TetMesh& mesh, const std::function<double(const Vec3&)>& function,
                    const CutOptions& options = {});

}  // namespace cavea
