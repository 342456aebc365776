#pragma once
#include <functional>
#include <limits>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

struct FeatureOptions {
  double angle = 45;          ///< degrees between the normals of two triangles above which a ridge
  bool detect_ridges = true;  ///< false: only the ridges that the mesh carries
  /// An edge is a ridge, whatever its angle, also where that angle (in radians) times the mean
  /// height of its two triangles over it exceeds this length; a curve has a corner where the same
  /// holds of its turn and its edges. For surfaces whose flat triangles are the truth.
  double crease = std::numeric_limits<double>::infinity();
  /// Whether that mean is the harmonic one, as edges across flat triangles sag; else triangles are
  /// smooth and bulge, each by its own height.
  bool flat = false;
  double least_crease_angle = 0;  ///< degrees; flatter edges are no such ridges
  /// Degrees; where a ridge ends, it goes on over edges ahead that fold by more and stand out from
  /// the folds around them. No ridge does if this is not below `angle`.
  double continued_above = 180;
  /// A triangle of less height than this may make no fold between two that make none without it,
  /// of which one is over its longest edge: its own normal is that of noise.
  double sliver = 0;
  /// A tip that stands out by less than this is noise.
  double least_tip = 0;
  /// If set, only edges that it takes are ridges, whether found or carried by the mesh. Called from
  /// many threads.
  std::function<bool(VertexId, VertexId)> may_be_ridge = {};
};

/// Classifies the surface of a mesh (paper, section 3.1): tags ridges by angle, corners (ends of
/// one or of three and more feature edges, sharp turns of a feature curve, meetings of curves of
/// different kinds, tips like that of a sharp cone, pinched vertices), feature vertices; numbers
/// the smooth patches (Triangle::patch): pieces connected through edges that are no features.
/// \return the number of patches.
int classify_features(TetMesh& mesh, const FeatureOptions& options);

}  // namespace cavea
