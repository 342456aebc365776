#pragma once
#include <cstdint>
#include <functional>
#include <optional>

#include "cavea/mesh/tet_mesh.h"

namespace cavea {

/// Coarsens the sizes of a run so that it ends with no more tets than it may have. How many tets
/// sizes come to is predicted: regular tets of the wanted sizes, integrated over the mesh, times a
/// ratio, which is known from experience at first and later from the run itself.
class Budget {
 public:
  explicit Budget(std::optional<std::int64_t> most_tets) : most_tets_(most_tets) {}

  /// How many times larger than asked for the sizes are; 1 where the budget does not bind.
  double scale() const { return scale_; }
  bool given() const { return most_tets_.has_value(); }
  bool binds() const { return scale_ > 1; }

  /// Finds the scale at which as many tets are predicted as there may be, or 1 if those are fewer.
  /// `set_sizes` sets mesh.sizes for the present scale; the last thing done.
  void fit(const TetMesh& mesh, const std::function<void()>& set_sizes);

  /// Learns the ratio from a mesh that is adapted to its sizes.
  void learn(const TetMesh& mesh);

  /// Whether a mesh has about as many tets as it may have, or fewer where the budget does not bind.
  bool met(const TetMesh& mesh) const;

 private:
  double excess(const TetMesh& mesh) const;

  std::optional<std::int64_t> most_tets_;
  double scale_ = 1;
  double tets_per_regular_ = kTetsPerRegular;

  /// Tets in a mesh of ours over regular tets of the wanted sizes: 1.12 to 1.21 on bodies with
  /// curved surfaces and graded maps, at 50 to 550 thousand tets.
  static constexpr double kTetsPerRegular = 1.16;
};

}  // namespace cavea
