#pragma once
#include "cavea/operator/context.h"

namespace cavea {

/// Edge collapse (paper, section 4.1.2): merges p into q. The ball of p is refilled by its tets
/// with q in place of p. \pre context.shell is the shell of the edge, with shell.p == p and shell.q
/// == q. \param quality_gain when true the collapse is wanted for the sake of quality: it must
/// raise the worst quality, and may leave long edges as long as that holds.
Verdict edge_collapse(OperatorContext& context, bool quality_gain, Cavity& cavity);

/// The same for a vertex p whose ball is gathered: several q are tried for one ball. \pre
/// context.ball is that of shell.p, context.around what is around; the shell of an edge inside
/// needs only p and q.
Verdict edge_collapse_of_ball(OperatorContext& context, bool quality_gain, Cavity& cavity);

}  // namespace cavea
