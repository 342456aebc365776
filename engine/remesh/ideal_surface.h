#pragma once
#include <functional>
#include <optional>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/remesh/known_sizes.h"
#include "cavea/remesh/options.h"
#include "cavea/remesh/resolved.h"
#include "cavea/surface/distance.h"
#include "cavea/surface/features.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// Places farther than this share of hausd are made finer: what lies between two samples may be
/// farther than they.
inline constexpr double kMeasuredShare = 0.95;

/// What the surface of a run's mesh is to be: the model of the input's own, or of the surface that
/// the caller names as the truth.
class IdealSurface {
 public:
  IdealSurface(const Options& options, const ResolvedOptions& resolved)
      : options_(options), r_(resolved), max_bulge_(resolved.max_bulge) {}
  IdealSurface(const IdealSurface&) = delete;
  IdealSurface& operator=(const IdealSurface&) = delete;

  /// Takes the model, classifies the mesh and sets its anchors; comes before all else.
  void take(TetMesh& mesh);

  /// The surface of edges that are `scale` times larger is farther from the model, as its square:
  /// operators are to allow that, save where another sheet is near.
  void loosen(TetMesh& mesh, double scale);

  /// A mesh that stands is as fine as its surface asks for: its triangles are within the tolerance
  /// of what they stand for, and a smooth surface that bulges more is not that.
  void trust_facets(TetMesh& mesh);

  /// The model as asked: what asks for sizes, and from which distances are measured.
  const SurfaceModel& model() const { return *model_; }
  /// The one that operators keep to.
  const SurfaceModel& working_model() const { return loose_ ? *loose_ : *model_; }

  /// The size that the model wants at each surface vertex; different ones may be asked for at once.
  std::function<double(VertexId)> sizes_of(const TetMesh& mesh);

  /// Lists what is beyond kMeasuredShare.
  SurfaceDistance distance_of(const TetMesh& mesh);
  double bulge();

 private:
  void attach(TetMesh& mesh);
  FeatureOptions features() const;
  void take_model(TetMesh& mesh, double looser, std::optional<SurfaceModel>& model) const;

  const Options& options_;
  const ResolvedOptions& r_;
  double max_bulge_, looser_ = 1;
  bool creases_ = true;  ///< whether folds that sag too much are ridges, whatever their angle
  std::optional<SurfaceModel> model_, loose_;
  KnownSizes known_sizes_;              ///< of model_
  std::optional<DistanceMeter> meter_;  ///< from model_
  std::optional<double> bulge_;         ///< of model_, once it was asked for
};

}  // namespace cavea
