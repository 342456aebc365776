#include "cavea/operator/face_swap.h"

namespace cavea {

Verdict face_swap(OperatorContext& c, TetId t, int f, Cavity& cavity) {
  const TetMesh& m = c.mesh;
  const FaceLink other = m.links[t][f];
  if (!other.is_tet()) return other.is_cut() ? Verdict::kFrozen : Verdict::kBreaksFeature;
  if ((m.tet_flags[t] | m.tet_flags[other.tet()]) & tet_flag::kRequired)
    return Verdict::kBreaksFeature;
  const double before = std::min(m.qualities[t], m.qualities[other.tet()]);
  const double threshold = std::max(kFlat, before * kQualityGain);
  const VertexId top = m.tets[t][f], bottom = m.tets[other.tet()][other.face()];
  cavity.clear();
  for (int k = 0; k < 3; ++k) {
    const VertexId a = m.tets[t][kFaceVertices[f][k]], b = m.tets[t][kFaceVertices[f][(k + 1) % 3]];
    // The face is counter-clockwise seen from `bottom`, so a to b turns around (top, bottom).
    const double quality = c.quality(top, bottom, a, b);
    if (quality <= threshold) return Verdict::kWorseQuality;
    cavity.tets.push_back({{top, bottom, a, b}, m.tet_refs[t], float(quality)});
  }
  cavity.removed_tets = {t, other.tet()};
  return Verdict::kAccept;
}

}  // namespace cavea
