#pragma once
#include <optional>
#include <vector>

#include "cavea/field/size_regions.h"
#include "cavea/field/wanted_sizes.h"
#include "cavea/remesh/budget.h"
#include "cavea/remesh/ideal_surface.h"
#include "cavea/remesh/resolved.h"
#include "cavea/remesh/size_law.h"
#include "cavea/surface/surface_model.h"

namespace cavea {

/// The sizes that a run wants: how its mesh gets them, and how they are lowered or coarsened.
class Sizing {
 public:
  /// \param field the caller's, with regions
  /// \param finer the share that is used of sizes that are not given
  Sizing(const ResolvedOptions& resolved, SizeField field, std::optional<std::int64_t> most_tets,
         double finer)
      : r_(resolved), field_(std::move(field)), budget_(most_tets), finer_(finer) {}

  /// Whether they vary over space, so that new vertices want theirs set anew.
  bool vary() const { return vary_; }
  /// Finds that in the classified input. Until then they do.
  void look_at(const TetMesh& mesh);

  /// Sets mesh.sizes to those of all who ask, as far as the budget allows.
  void set(TetMesh& mesh, IdealSurface& surface);
  /// To those that follow from the curvature alone.
  void set_curved(TetMesh& mesh, const SurfaceModel& surface) const;
  /// Vertices have moved since their sizes were set, so that set anew all would change a little:
  /// what the spots alone ask for, in the surface, counts where it is less. \param finest of the
  /// spots \param hgrad how fast sizes rise from there \return the sizes before
  std::vector<float> lower(TetMesh& mesh, const SurfaceModel& surface,
                           std::vector<SizeSphere> spots, double finest, double hgrad) const;

  SizeLaw law() const;

  double finer() const { return finer_; }
  void use(double finer) { finer_ = finer; }

  const Budget& budget() const { return budget_; }
  Budget& budget() { return budget_; }

 private:
  SizeBounds bounds(double hmin) const;

  const ResolvedOptions& r_;
  SizeField field_;
  Budget budget_;
  double finer_;
  bool vary_ = true;
};

}  // namespace cavea
