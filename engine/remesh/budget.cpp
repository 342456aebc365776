#include "cavea/remesh/budget.h"

#include <algorithm>
#include <cmath>

#include "cavea/mesh/wanted_tets.h"

namespace cavea {
namespace {

/// A scale this near is left: a change of 1.5% in the number of tets.
constexpr double kSameScale = 0.005;
/// The gradation and imposed sizes do not scale, so one step is not enough; each leaves a fraction
/// of the error.
constexpr int kSteps = 10;
/// A ratio is believed to change by no more than this from one round to the next: regular lattices
/// conform with half as many tets or twice as many, until they are disturbed.
constexpr double kMostChange = 1.25;
/// How far the number may be from the budget before another round is worth it; half of what is
/// promised, since the last phases change it too.
constexpr double kNearEnough = 0.05;

}  // namespace

double Budget::excess(const TetMesh& mesh) const {
  return tets_per_regular_ * wanted_tets(mesh) / double(*most_tets_);
}

void Budget::fit(const TetMesh& mesh, const std::function<void()>& set_sizes) {
  set_sizes();
  for (int step = 0; given() && step < kSteps; ++step) {
    const double scale = std::max(1.0, scale_ * std::cbrt(excess(mesh)));
    if (std::abs(scale - scale_) <= kSameScale * scale_) return;
    scale_ = scale;
    set_sizes();
  }
}

void Budget::learn(const TetMesh& mesh) {
  if (!given()) return;
  const double ratio = double(mesh.tets.size()) / wanted_tets(mesh);
  tets_per_regular_ =
      std::clamp(ratio, tets_per_regular_ / kMostChange, tets_per_regular_ * kMostChange);
}

bool Budget::met(const TetMesh& mesh) const {
  if (!given()) return true;
  const double share = double(mesh.tets.size()) / double(*most_tets_);
  return share <= 1 + kNearEnough && (!binds() || share >= 1 - kNearEnough);
}

}  // namespace cavea
