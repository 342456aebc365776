#include "cavea/implicit/mesh_level_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "cavea/base/atomic.h"
#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/implicit/box_mesh.h"
#include "cavea/implicit/clear.h"
#include "cavea/implicit/keep.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/statistics.h"

namespace cavea {
namespace {

// Vertices that are put onto the level set make chords longer.
constexpr double kClearing = 2;

// Those that are moved away from it may leave it too coarse.
constexpr int kMostClearings = 2;

/// Makes the mesh of a box in which a stack of level sets is cut, the first one first: what is
/// inside of one is not divided by those after it.
class StackMesher {
 public:
  StackMesher(const Box& box, std::span<const StackedLevelSet> stack, const CutOptions& options)
      : stack_(stack), options_(options), mesh_(build(box_mesh(box)).mesh) {
    for (const StackedLevelSet& s : stack) {
      shifted_.push_back(
          with_gradient(less(s.level_set, options.isovalue), distance(box.low, box.high)));
      zeros_.push_back(visible_zeros(box));
    }
  }

  StackResult run() {
    for (std::size_t k = 0; k < stack_.size(); ++k)
      named(k, [&] { refine_near(mesh_, shifted_[k], zeros_[k], stack_[k].refine); });
    for (std::size_t k = 0; k < stack_.size(); ++k) named(k, [&] { make_room(k); });
    for (std::size_t k = 0; k < stack_.size(); ++k) {
      named(k, [&] { cut(k); });
      earlier_.push_back({shifted_[k], interface_ref(options_, k)});
    }
    keep_side();
    return {std::move(mesh_), std::move(reports_)};
  }

 private:
  /// The zeros of the last one in shifted_ that are not inside of those before it.
  std::vector<OrientedPoint> visible_zeros(const Box& box) const {
    constexpr double kLattice = 64;
    const std::size_t k = shifted_.size() - 1;
    const Vec3 side = box.high - box.low;
    std::vector<OrientedPoint> zeros(stack_[k].zeros.begin(), stack_[k].zeros.end());
    if (zeros.empty())
      zeros = zeros_on_lattice(shifted_[k], box, std::max({side.x, side.y, side.z}) / kLattice);
    std::erase_if(zeros, [&](const OrientedPoint& zero) { return is_inside(zero.place, k); });
    return zeros;
  }

  /// Whether a point is inside of one of the first n.
  bool is_inside(const Vec3& p, std::size_t n) const {
    return std::any_of(shifted_.begin(), shifted_.begin() + std::ptrdiff_t(n),
                       [&](const LevelSet& earlier) { return earlier.value(p) < 0; });
  }

  void make_room(std::size_t k) {
    const RefineOptions again{kClearing * stack_[k].refine.tolerance, stack_[k].refine.shortest};
    for (int round = 0; round < kMostClearings; ++round) {
      clear_for_cut(mesh_, shifted_[k], again.tolerance, {.fixed = vertices_of_earlier(k)});
      if (refine_near(mesh_, shifted_[k], zeros_[k], again) == 0) break;
    }
  }

  /// The vertices of tets that are not wholly outside of the first n: there is room already, or
  /// nothing to be cut.
  std::vector<char> vertices_of_earlier(std::size_t n) const {
    std::vector<char> is_of(mesh_.points.size(), 0), touched(mesh_.points.size());
    parallel_for(touched.size(), [&](std::size_t v) {
      touched[v] =
          std::any_of(shifted_.begin(), shifted_.begin() + std::ptrdiff_t(n),
                      [&](const LevelSet& earlier) { return earlier.value(mesh_.points[v]) <= 0; });
    });
    parallel_for(mesh_.tets.size(), [&](std::size_t t) {
      const auto& tet = mesh_.tets[t];
      if (std::ranges::any_of(tet, [&](VertexId v) { return touched[v]; }))
        for (const VertexId v : tet) atomic_or(is_of[v], char{1});
    });
    return is_of;
  }

  /// Where the level set meets those along which the mesh is cut already.
  void make_room_on_earlier(std::size_t k) {
    std::vector<char> split(mesh_.tets.size());
    parallel_for(split.size(),
                 [&](std::size_t t) { split[t] = mesh_.tet_refs[t] == options_.material.outside; });
    clear_for_cut(mesh_, shifted_[k], kClearing * stack_[k].refine.tolerance,
                  {.split = std::move(split), .earlier = earlier_});
  }

  void cut(std::size_t k) {
    if (k > 0) make_room_on_earlier(k);
    CutOptions options = options_;
    options.material.inside = inside_ref(options_, k);
    options.interface_ref = interface_ref(options_, k);
    if (stack_.size() > 1) options.keep = CutKeep::kBoth;  // until all are cut
    for (std::size_t j = 0; j < k; ++j)
      options.material_of_ref[inside_ref(options_, j)] = CutMaterial{.split = false};
    CutResult result = cut_along(mesh_, stack_[k].level_set, options);
    if (k > 0 && !count(result.mesh).tets_of_ref.contains(options.material.inside))
      throw InputError("nothing of its inside is outside of the level sets before it");
    mesh_ = std::move(result.mesh);
    reports_.push_back(result.report);
  }

  void keep_side() {
    if (options_.keep == CutKeep::kBoth || stack_.size() == 1) return;
    MeshData data = to_data(mesh_);
    const bool outside = options_.keep == CutKeep::kOutside;
    keep_tets(data, [&](std::size_t t) {
      return (mesh_.tet_refs[t] == options_.material.outside) == outside;
    });
    mesh_ = build(std::move(data)).mesh;
  }

  /// Calls f; what it throws about the input gets the name of the k-th level set.
  void named(std::size_t k, const std::function<void()>& f) const {
    try {
      f();
    } catch (const InputError& e) {
      if (stack_[k].name.empty()) throw;
      throw InputError(stack_[k].name + ": " + e.what());
    }
  }

  const std::span<const StackedLevelSet> stack_;
  const CutOptions& options_;
  TetMesh mesh_;
  std::vector<LevelSet> shifted_;  ///< with gradients, less the isovalue
  std::vector<std::vector<OrientedPoint>> zeros_;
  std::vector<MeshedLevelSet> earlier_;  ///< those along which mesh_ is cut
  std::vector<CutReport> reports_;
};

/// \throw OptionError
void check_references(std::size_t count, const CutOptions& options) {
  if (!options.material_of_ref.empty())
    throw OptionError("materials by reference are for a single level set");
  const std::int64_t first = options.material.inside, outside = options.material.outside;
  if (first <= outside && outside < first + std::int64_t(count))
    throw OptionError(
        fmt::format("the references inside, {} to {}, are to be others than the one outside", first,
                    first + std::int64_t(count) - 1));
}

}  // namespace

CutResult mesh_level_set(const Box& box, const LevelSet& level_set,
                         std::span<const OrientedPoint> zeros, const RefineOptions& refine,
                         const CutOptions& cut) {
  StackResult result =
      mesh_level_sets(box, std::array{StackedLevelSet{level_set, zeros, refine, {}}}, cut);
  return {std::move(result.mesh), result.reports[0]};
}

StackResult mesh_level_sets(const Box& box, std::span<const StackedLevelSet> stack,
                            const CutOptions& cut) {
  if (stack.size() > 1) check_references(stack.size(), cut);
  return StackMesher(box, stack, cut).run();
}

}  // namespace cavea
