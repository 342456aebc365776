#pragma once
#include <algorithm>
#include <limits>
#include <optional>
#include <span>

#include "cavea/field/local_parameters.h"
#include "cavea/field/size_field.h"
#include "cavea/mesh/tet_mesh.h"

namespace cavea {

struct SizeBounds {
  double hmin = 0, hmax = 0;
  std::span<const LocalParameters> local = {};  ///< other bounds, by reference
  double finer = 1;                             ///< of what is wished, before it is bounded
  double scale = 1;                             ///< of what has been bounded, before the gradation
  double hgrad = 1;                             ///< infinity for no bound
  /// The gradation from required entities; they impose the lengths of their own edges. None: they
  /// impose nothing.
  std::optional<double> hgradreq;
  bool surface_imposes = false;  ///< the whole surface counts as required, even without hgradreq
};

/// The smallest and largest of some sizes; empty (smallest > largest) at first.
struct SizeRange {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;

  void add(double size) {
    smallest = std::min(smallest, size);
    largest = std::max(largest, size);
  }
};

/// What the user's field asks for at the vertices; what is not positive is passed over.
SizeRange wished_range(const TetMesh& mesh, const SizeField& field);

/// Sets mesh.sizes (paper, section 4.2): the smaller of `curvature_size` (of surface vertices) and
/// the user's field, then the bounds, then the gradation, also that from required entities, which
/// bounds do not concern. \pre no holes \throw InputError when the user's field gives a size that
/// is not a positive number
void set_wanted_sizes(TetMesh& mesh, const std::function<double(VertexId)>& curvature_size,
                      const SizeField& field, const SizeBounds& bounds);

/// Lowers mesh.sizes to `size` of surface vertices, by anchor, within the bounds, and around them
/// to what the gradation asks for; no other size changes. \pre no holes \return the sizes before
std::vector<float> lower_wanted_sizes(TetMesh& mesh,
                                      const std::function<double(const Anchor&)>& size,
                                      const SizeBounds& bounds);

}  // namespace cavea
