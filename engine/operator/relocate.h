#pragma once
#include "cavea/operator/context.h"

namespace cavea {

/// Relocation (paper, section 4.1.4): interior vertices towards the mean of the places that would
/// make each tet of the ball regular, surface vertices likewise but in the tangent plane and back
/// onto the ideal surface, feature vertices along their curve. Accepted where the worst quality of
/// the ball rises, or stays and the mean rises. On acceptance `to` is the vertex' new state, and
/// context.ball and context.qualities its tets with their new qualities, as MeshEditor::move()
/// takes them.
Verdict relocate(OperatorContext& context, VertexId v, NewVertex& to);

/// The same where the ball is known. \pre context.ball is that of v.
Verdict relocate_in_ball(OperatorContext& context, VertexId v, NewVertex& to);

/// Moves an interior vertex whose ball is on the average worse than `below` by a fifth of its
/// wanted size in a direction that depends on its place, if no tet gets worse than `floor`. \pre
/// context.ball is that of v.
Verdict shake(OperatorContext& context, VertexId v, double below, double floor, NewVertex& to);

}  // namespace cavea
