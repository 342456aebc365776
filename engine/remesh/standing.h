#pragma once
// Whether a mesh stands: it is on the whole what a run would make of it.
#include <cstdint>
#include <functional>
#include <vector>

#include "cavea/mesh/tet_mesh.h"
#include "cavea/remesh/options.h"
#include "cavea/remesh/report.h"

namespace cavea {

/// Results have no worse tets where the domain does not force them.
inline constexpr double kPoorQuality = 0.4;

/// Whether all lengths are such as results have.
bool no_length_is_poor(const LengthStatistics& now);

/// What a gradation steeper than the default costs of the mean quality, where sizes vary; else 0.
double mean_lost_to_gradation(const Options& options);

/// Whether the mean quality is what runs reach on bodies that are nowhere thin.
bool has_the_quality_of_results(const QualityStatistics& now, bool uniform, const Options& options);

/// The same, and as many lengths conform as the options want.
bool is_as_good_as_results(const MeshSummary& now, bool uniform, const Options& options);

/// Whether the worst quality was poor and is better by more than chance would make it.
bool worst_has_risen(const MeshSummary& before, const MeshSummary& after);

/// Whether the quality, and lengths that missed their target, have not become better by more than
/// chance would make them, nor met a target of the options that they missed.
bool gained_nothing(const MeshSummary& before, const MeshSummary& after, const Options& options);

/// Whether the caller says what the sizes are, and not the surface alone.
bool sizes_are_given(const Options& options, bool has_field);

/// How a mesh lies in sizes that follow from the curvature alone: thin walls ask for less so that
/// good tets fit, and where all are good they do.
struct InCurvedSizes {
  LengthStatistics lengths;
  double bulge = 0;  ///< of the smooth model from the facets, in hausd
};

/// Whether the mesh may be a result whose surface asks for other sizes: of the quality of results
/// where sizes vary, and neither too fine nor too coarse as a whole.
bool is_nearly_result(const MeshSummary& now, const InCurvedSizes& curved, const Options& options);

/// The same for a mesh for which a run has made its sizes finer, since the body has no room for
/// those wanted.
bool may_have_made_room(const MeshSummary& now, const InCurvedSizes& curved,
                        const Options& options);

/// The sizes that a mesh has: at least 0.15 of those wanted, and at most 1.25 of `largest`.
std::vector<float> own_sizes_within(const TetMesh& mesh, double largest);

/// The same only where edges are clearly shorter than wanted: all others stay as they are.
void give_way_to_own(TetMesh& mesh);

/// How many tets are poor: far from what is wanted, in quality or in length. Needs the sizes.
std::int64_t count_poor(const TetMesh& mesh);

/// Whether there is none, as the statistics of the mesh tell.
bool none_is_poor(const MeshSummary& now);

/// Whether there are only as many as results have by chance, and those would do: to mend them asks
/// far more around them.
bool poor_by_chance(const MeshSummary& now, std::int64_t poor);

/// Whether so few are poor that they may be mended one by one.
bool few_are_poor(const TetMesh& mesh);

/// Asks the poor tets everything, or those of them that are concerned.
void ask_poor(TetMesh& mesh, const std::function<bool(TetId)>& concerns = {});

}  // namespace cavea
