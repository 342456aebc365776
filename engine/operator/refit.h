#pragma once
#include <span>

#include "cavea/operator/context.h"

namespace cavea {

/// Whether the surface triangles of a cavity with a new vertex may replace those that go, as
/// judge_surface() has it; and no sample of the ideal surface below those that go is left farther
/// than its tolerance from all that come, nor farther than it was. \param vertex_id of the new
/// vertex \param hints more anchors near it
Verdict check_refit(const OperatorContext& context, const Cavity& cavity, VertexId vertex_id,
                    std::span<const Anchor> hints);

}  // namespace cavea
