#include "cavea/implicit/cut.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "cavea/base/error.h"
#include "cavea/base/parallel.h"
#include "cavea/implicit/islands.h"
#include "cavea/implicit/keep.h"
#include "cavea/implicit/normals.h"
#include "cavea/implicit/recovered_gradients.h"
#include "cavea/implicit/signs.h"
#include "cavea/mesh/build.h"
#include "cavea/mesh/faces.h"
#include "cavea/mesh/statistics.h"
#include "cavea/subdivide/subdivide.h"

namespace cavea {
namespace {

void check_options(const CutOptions& options) {
  if (!std::isfinite(options.isovalue))
    throw OptionError(fmt::format("the isovalue must be finite, not {}", options.isovalue));
  if (!(options.remove_components >= 0 && options.remove_components < 1))
    throw OptionError(fmt::format("the share of components to remove must be in [0, 1), not {}",
                                  options.remove_components));
}

/// The values less the isovalue. \throw InputError
std::vector<double> checked_values(const TetMesh& mesh, std::span<const double> values,
                                   double isovalue, CutReport& report) {
  if (values.size() != mesh.points.size())
    throw InputError(fmt::format("the level set has {} values for {} vertices", values.size(),
                                 mesh.points.size()));
  const auto bad = std::ranges::find_if(values, [](double x) { return !std::isfinite(x); });
  if (bad != values.end())
    throw InputError(
        fmt::format("the level set's value at vertex {} is {}", bad - values.begin() + 1, *bad));
  const auto [least, most] = std::ranges::minmax(values);
  if (!(least < isovalue && isovalue < most))
    throw InputError(fmt::format("the level set is nowhere {}: its values are from {} to {}",
                                 isovalue, least, most));
  report.smallest_value = least;
  report.largest_value = most;
  std::vector<double> out(values.begin(), values.end());
  for (double& x : out) x -= isovalue;
  return out;
}

class Cut {
 public:
  /// \param level_set what the values are of, with a gradient; null if only they are known
  Cut(const TetMesh& mesh, std::vector<double> values, const LevelSet* level_set,
      const CutOptions& options, CutReport& report)
      : mesh_(mesh),
        values_(std::move(values)),
        level_set_(level_set),
        options_(options),
        report_(report),
        signs_(cut_signs(mesh, values_, splits())) {
    if (!level_set) gradients_.emplace(mesh, values_);
    report_.vertices_on_interface = std::ranges::count(signs_, 0);
    silence_unsplit();
  }

  TetMesh run() {
    refuse_required();
    report_.open = std::ranges::any_of(mesh_.triangles, [&](const Triangle& s) {
      return s.is_exterior() && (crossed(s.v[0], s.v[1]) || crossed(s.v[1], s.v[2]));
    });
    cut_ = subdivide(
        mesh_, [&](const MeshEdge& e) { return crossed(e.a, e.b); },
        [&](const MeshEdge& e) { return vertex_on(e); }, 0);
    gradients_.reset();
    find_sides();
    remove_islands();
    return finish();
  }

 private:
  /// By tet, whether its material is to be divided.
  std::vector<char> splits() const {
    std::vector<char> out(mesh_.tets.size());
    parallel_for(out.size(), [&](std::size_t t) { out[t] = material(mesh_.tet_refs[t]).split; });
    return out;
  }

  /// Where no tet is to be divided no edge is cut: vertices there are of no side.
  void silence_unsplit() {
    std::vector<char> has_a_say(signs_.size(), 0);
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
      for (const VertexId v : mesh_.tets[t]) has_a_say[v] |= material(mesh_.tet_refs[t]).split;
    for (std::size_t v = 0; v < signs_.size(); ++v) signs_[v] *= has_a_say[v];
  }

  bool crossed(VertexId a, VertexId b) const { return signs_[a] * signs_[b] < 0; }

  NewVertex vertex_on(const MeshEdge& e) const {
    NewVertex made = straight_midpoint(mesh_, e);
    const Vec3 a = mesh_.points[e.a], b = mesh_.points[e.b];
    const double share = level_set_ ? zero_on_edge(*level_set_, a, b, values_[e.a], values_[e.b])
                                    : gradients_->zero_on_edge(e.a, e.b);
    made.point = a + (b - a) * std::clamp(share, kLeastCutShare, 1 - kLeastCutShare);
    return made;
  }

  void refuse_required() const {
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t)
      for (const auto& e : kEdgeVertices)
        if ((mesh_.tet_flags[t] & tet_flag::kRequired) &&
            crossed(mesh_.tets[t][e[0]], mesh_.tets[t][e[1]]))
          throw InputError(fmt::format("the level set cuts required tet {}", t + 1));
    for (std::size_t s = 0; s < mesh_.triangles.size(); ++s)
      for (int k = 0; k < 3; ++k) refuse_required(s, k);
  }

  void refuse_required(std::size_t s, int k) const {
    const Triangle& triangle = mesh_.triangles[s];
    const VertexId a = triangle.v[(k + 1) % 3], b = triangle.v[(k + 2) % 3];
    if (!triangle.alive() || !crossed(a, b)) return;
    if (triangle.tags & tag::kRequired)
      throw InputError(fmt::format("the level set cuts required triangle {}", s + 1));
    if (triangle.edge_tag[k] & tag::kRequired)
      throw InputError(fmt::format("the level set cuts the required edge of vertices {} and {}",
                                   std::min(a, b) + 1, std::max(a, b) + 1));
  }

  const CutMaterial& material(std::int32_t ref) const {
    const auto found = options_.material_of_ref.find(ref);
    return found == options_.material_of_ref.end() ? options_.material : found->second;
  }

  void find_sides() {
    // New vertices are on the interface and have no say.
    signs_.resize(cut_.points.size(), 0);
    values_.resize(cut_.points.size(), 0);
    sides_.resize(cut_.tets.size());
    parallel_for(cut_.tets.size(), [&](std::size_t t) {
      sides_[t] = material(cut_.tet_refs[t]).split
                      ? std::int8_t(side_of_tet(cut_.tets[t], signs_, values_))
                      : std::int8_t(0);
    });
  }

  void remove_islands() {
    if (options_.remove_components == 0) return;
    const double least = options_.remove_components * count(cut_).volume;
    report_.removed_components = turn_islands(cut_, -1, least, false, sides_);
    report_.filled_cavities = turn_islands(cut_, 1, least, true, sides_);
  }

  /// Calls f(tet, face) once for each face of the interface, from inside.
  template <class F>
  void for_each_interface(F&& f) const {
    for (std::size_t t = 0; t < cut_.tets.size(); ++t)
      for (int i = 0; i < 4 && sides_[t] < 0; ++i)
        if (const FaceLink next = cut_.across(TetId(t), i); next.is_tet() && sides_[next.tet()] > 0)
          f(TetId(t), i);
  }

  TetMesh finish() {
    for_each_interface([&](TetId t, int i) {
      if (const FaceLink link = cut_.links[t][i]; link.is_triangle())
        cut_.triangles[link.triangle()].ref = options_.interface_ref;
    });
    MeshData data = to_data(cut_);
    std::vector<char> on_interface(data.vertices.size(), 0);
    for_each_interface([&](TetId t, int i) {
      const auto face = face_vertices(cut_.tets[t], i);
      for (const VertexId v : face) on_interface[v] = 1;
      ++report_.interface_triangles;
      if (cut_.links[t][i].is_triangle()) return;  // listed already
      data.triangles.push_back(face);
      data.triangle_refs.push_back(options_.interface_ref);
    });
    for (std::size_t t = 0; t < data.tets.size(); ++t)
      if (sides_[t] != 0) {
        const CutMaterial& m = material(cut_.tet_refs[t]);
        data.tet_refs[t] = sides_[t] < 0 ? m.inside : m.outside;
      }
    if (level_set_) {
      add_normals(*level_set_, cut_, on_interface, data);
      measure_sagitta();
    }
    keep_side(data);
    return build(std::move(data)).mesh;
  }

  void measure_sagitta() {
    for_each_interface([&](TetId t, int i) {
      const auto [a, b, c] = face_vertices(cut_.tets[t], i);
      const auto &p = cut_.points[a], &q = cut_.points[b], &r = cut_.points[c];
      for (const Vec3& at : {(p + q) / 2, (q + r) / 2, (r + p) / 2, (p + q + r) / 3})
        report_.sagitta = std::max(report_.sagitta, height(at));
    });
  }

  /// The distance of the zero to first order: the value over the slope.
  double height(const Vec3& p) const {
    const double height = std::abs(level_set_->value(p)) / norm(level_set_->gradient(p));
    return std::isfinite(height) ? height : 0;
  }

  void keep_side(MeshData& data) const {
    if (options_.keep == CutKeep::kBoth) return;
    const std::int8_t kept = options_.keep == CutKeep::kInside ? -1 : 1;
    keep_tets(data, [&](std::size_t t) { return sides_[t] == kept; });
  }

  const TetMesh& mesh_;
  std::vector<double> values_;
  const LevelSet* level_set_;
  std::optional<RecoveredGradients>
      gradients_;  ///< if there is no level_set_, until the mesh is cut
  const CutOptions& options_;
  CutReport& report_;
  std::vector<std::int8_t> signs_;
  TetMesh cut_;
  std::vector<std::int8_t> sides_;  ///< by tet of cut_: -1 inside, 1 outside, 0 not split
};

CutResult cut(const TetMesh& mesh, std::span<const double> values, const LevelSet* level_set,
              const CutOptions& options) {
  check_options(options);
  CutResult out;
  std::vector<double> shifted = checked_values(mesh, values, options.isovalue, out.report);
  out.mesh = Cut(mesh, std::move(shifted), level_set, options, out.report).run();
  return out;
}

}  // namespace

CutResult cut_along(const TetMesh& mesh, std::span<const double> values,
                    const CutOptions& options) {
  return cut(mesh, values, nullptr, options);
}

CutResult cut_along(const TetMesh& mesh, const LevelSet& level_set, const CutOptions& options) {
  std::vector<double> values(mesh.points.size());
  parallel_for(values.size(), [&](std::size_t v) { values[v] = level_set.value(mesh.points[v]); });
  const LevelSet shifted = with_gradient(less(level_set, options.isovalue), box_diagonal(mesh));
  return cut(mesh, values, &shifted, options);
}

CutResult cut_along(const TetMesh& mesh, const std::function<double(const Vec3&)>& function,
                    const CutOptions& options) {
  return cut_along(mesh, LevelSet{function, {}}, options);
}

}  // namespace cavea
