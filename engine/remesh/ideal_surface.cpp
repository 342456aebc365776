#include "cavea/remesh/ideal_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "cavea/base/error.h"
#include "cavea/mesh/statistics.h"
#include "cavea/surface/attach.h"
#include "cavea/surface/features.h"

namespace cavea {
namespace {

FeatureOptions feature_options(const Options& options, const ResolvedOptions& r) {
  // An edge of the wanted size h across a fold of angle a sags by h a / 4; where triangles of
  // height w meet at a, h = sqrt(4.5 hausd w / a). Beyond a w = 3 hausd the sag is too large:
  // then edges must follow the fold, and w is no less than about h, so that they can.
  constexpr double kFold = 3;
  // A smooth surface there would bulge by w a / 8. What is above the bound remains as a crease,
  // of angle a' with w a' = w a - 8 bulge, to which sizes of about 3.5 hausd / a' belong. Beyond
  // 6 of them in w it is better to follow the crease, too; but where it is slight the shape is
  // meant to be smooth, and only the tolerance too small for its facets.
  constexpr double kBulge = 8, kCrease = 6 * 3.5, kSlight = 20;
  // Of hausd, which the surface may be off anyway; but a tip that is let go slides down by more.
  constexpr double kSliver = 1, kTip = 0.5;
  FeatureOptions o;
  o.sliver = kSliver * r.hausd, o.least_tip = kTip * r.hausd;
  o.angle = options.angle, o.detect_ridges = options.detect_ridges;
  if (options.faceted) {
    o.crease = kFold * r.hausd, o.flat = true;
  } else if (o.detect_ridges) {
    o.crease = kBulge * r.max_bulge + kCrease * r.hausd, o.least_crease_angle = kSlight;
    // What is left of a ridge that goes on until it is as slight is round within the tolerance.
    o.continued_above = kSlight;
  }
  return o;
}

/// A mesh is only brought onto a surface that is its own.
/// \throw InputError naming the farthest vertex
void require_near(const TetMesh& mesh, const SurfaceModel& model, double hausd) {
  // Results are within hausd and the bulge, four of them in all, and programs that drift end at 22.
  // The mesh may have been made with a larger hausd than is asked for here.
  constexpr double kFarthest = 30, kShareOfDiagonal = 0.03;
  const OffVertex far = farthest_vertex(mesh, model);
  if (far.distance <= std::max(kFarthest * hausd, kShareOfDiagonal * box_diagonal(mesh))) return;
  const Vec3& where = mesh.points[far.vertex];
  throw InputError(fmt::format(
      "the mesh is not on the surface given: its vertex at ({:g}, {:g}, {:g}) is {:g} away",
      where.x, where.y, where.z, far.distance));
}

}  // namespace

void IdealSurface::take(TetMesh& mesh) {
  if (!options_.surface) classify_features(mesh, features());
  take_model(mesh, 1, model_);
  if (options_.surface) attach(mesh);
}

/// A mesh that was made after another model of the same surface may have no edges along creases of
/// this one. Then they are none of this model either: its patches would end where no edge of the
/// mesh can be.
void IdealSurface::attach(TetMesh& mesh) {
  constexpr double kMostOff = 1e-3;  // of the area
  const std::vector<Triangle> triangles = mesh.triangles;
  const std::vector<Tag> vertex_tags = mesh.vertex_tags;
  require_near(mesh, *model_, r_.hausd);
  if (attach_to(mesh, *model_, features(), r_.hausd) <= kMostOff) return;
  mesh.triangles = triangles;
  mesh.vertex_tags = vertex_tags;
  creases_ = false;
  take_model(mesh, 1, model_);
  attach_to(mesh, *model_, features(), r_.hausd);
}

FeatureOptions IdealSurface::features() const {
  FeatureOptions o = feature_options(options_, r_);
  if (!creases_) o.crease = std::numeric_limits<double>::infinity();
  return o;
}

void IdealSurface::loosen(TetMesh& mesh, double scale) {
  looser_ = scale * scale;
  take_model(mesh, looser_, loose_);
}

void IdealSurface::trust_facets(TetMesh& mesh) {
  constexpr double kTrusted = 0.9;  // so that what lies between samples is within, too
  max_bulge_ = std::min(max_bulge_, kTrusted * r_.hausd);
  // Where curves bulge within a facet beside them they are near, but their chords are not.
  if (bulge() <= max_bulge_ && distance_of(mesh).worse().worst <= 1) return;
  model_->limit_bulge(max_bulge_);
  known_sizes_.forget();
  meter_.reset();
  bulge_.reset();
  if (loose_) take_model(mesh, looser_, loose_);
}

std::function<double(VertexId)> IdealSurface::sizes_of(const TetMesh& mesh) {
  known_sizes_.make_room(mesh.points.size());
  return [this, &mesh](VertexId v) {
    return known_sizes_(v, mesh.anchors[v], [this](const Anchor& a) { return model_->size(a); });
  };
}

SurfaceDistance IdealSurface::distance_of(const TetMesh& mesh) {
  // A triangle that is so near at seven samples is not beyond the tolerance at others: bumps of
  // the model below it are sampled from their own side.
  constexpr double kNear = 0.5;
  // What is known of a mesh whose triangles were far larger may miss what is between samples.
  constexpr double kFarFiner = 0.8;
  const SampleSteps steps = default_sample_steps(mesh, *model_);
  if (!meter_ || steps.out < kFarFiner * meter_->steps().out ||
      steps.model < kFarFiner * meter_->steps().model)
    meter_.emplace(*model_, DistanceSampling{steps, kMeasuredShare, kNear});
  return meter_->measure(mesh);
}

double IdealSurface::bulge() {
  if (!bulge_) bulge_ = measure_bulge(*model_);
  return *bulge_;
}

/// `looser` multiplies the tolerances. \param mesh is classified, if its surface is the truth
void IdealSurface::take_model(TetMesh& mesh, double looser,
                              std::optional<SurfaceModel>& model) const {
  auto of_reference = r_.hausd_of_triangles;
  for (auto& [reference, hausd] : of_reference) hausd *= looser;
  const SurfaceModel::Settings settings{looser * r_.hausd, max_bulge_, r_.smallest, r_.largest,
                                        of_reference};
  if (!options_.surface) {
    model.emplace(mesh, settings);
    return;
  }
  TetMesh truth = *options_.surface;
  classify_features(truth, features());
  model.emplace(truth, settings);
}

}  // namespace cavea
