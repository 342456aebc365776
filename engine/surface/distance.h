#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// How far the samples of one surface are from another.
struct OneSidedDistance {
  double max = 0;
  double mean = 0;   ///< weighted by area; 0 if not all samples are asked for
  double worst = 0;  ///< largest in hausd of the facets there, which may differ by reference
  double hausd = 0;  ///< that of the worst sample's facet
  Vec3 where;        ///< the worst sample
};

/// A triangle or facet with a sample that is too far.
struct FarSample {
  std::int32_t id = kNone;  ///< TriangleId of the mesh, or facet of the model
  Vec3 where;               ///< its farthest sample
  double distance = 0, hausd = 0;
  TriangleId triangle = kNone;  ///< of the mesh, which holds the sample or is nearest to it
};

/// The two-sided distance between a mesh's surface and the ideal surface, in the mesh's unit of
/// length.
struct SurfaceDistance {
  OneSidedDistance out_to_model;  ///< of the mesh's triangles from the model's patches
  OneSidedDistance model_to_out;  ///< of the model's patches from the mesh's triangles
  std::vector<FarSample> far_triangles, far_facets;  ///< in the order of the ids

  double max() const { return std::max(out_to_model.max, model_to_out.max); }
  const OneSidedDistance& worse() const {
    return out_to_model.worst > model_to_out.worst ? out_to_model : model_to_out;
  }
};

/// Spacings of samples, greater than 0.
struct SampleSteps {
  double out, model;  ///< on the mesh's triangles, and on the model's facets
};

/// How closely surfaces are sampled, and which samples are listed: see measure_surface_distance().
struct DistanceSampling {
  SampleSteps step;
  double most = std::numeric_limits<double>::infinity();
  double enough = 0;
};

/// Measures the distances of a mesh that changes from a model that does not: what has not changed
/// since the last mesh, nor is near anything that has, is not sampled again. What it says is what
/// measure_surface_distance() says of the last mesh alone.
class DistanceMeter {
 public:
  /// \param model must outlive the meter
  DistanceMeter(const SurfaceModel& model, const DistanceSampling& sampling);
  ~DistanceMeter();

  SurfaceDistance measure(const TetMesh& mesh);

  const SampleSteps& steps() const;

 private:
  struct Memory;
  std::unique_ptr<Memory> memory_;
};

/// Measures the Hausdorff distance on samples: each triangle, and each patch over its facet, on a
/// barycentric lattice whose spacing on the flat triangle is at most `step`, coarser where a
/// triangle would have more than about 2,000 samples; its corners, edge midpoints and centroid are
/// always among them, and where these come near hausd it is looked for peaks between them.
/// Distances below a billionth of hausd are rounding, and may be bounds. Each
/// sample is measured against all of the other surface, whatever its patches. Infinite from a
/// surface that is empty; 0 of one that is. The same bits at any number of threads. \param step
/// greater than 0 \param enough where corners, edge midpoints and centroid are all within so many
/// hausd, no more samples are taken; if not 0, what is nearer than the farthest is not measured
/// exactly, and there is no mean \param most triangles and facets with samples beyond so many hausd
/// are listed
SurfaceDistance measure_surface_distance(const TetMesh& mesh, const SurfaceModel& model,
                                         double step,
                                         double most = std::numeric_limits<double>::infinity(),
                                         double enough = 0);

/// Largest distance of the model's patches from its own flat facets.
double measure_bulge(const SurfaceModel& model);

/// 1/400 of the model's box diagonal, or more where that would take more than about 50 samples of
/// a mesh's triangle on the average, or 7 of the model beside one: a facet may be far larger, and
/// what is nearest to it changes from triangle to triangle.
SampleSteps default_sample_steps(const TetMesh& mesh, const SurfaceModel& model);

}  // namespace cavea
