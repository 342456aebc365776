#include "cavea/operator/delaunay_cavity.h"

#include <algorithm>
#include <cmath>

namespace cavea {

bool in_sphere(const Vec3& p, const std::array<Vec3, 4>& tet) {
  constexpr double kOnSphere = 1e-9;  // rounding of points a thousandth of the mesh apart is 1e-12
  const Vec3 a = tet[0] - p, b = tet[1] - p, c = tet[2] - p, d = tet[3] - p;
  const Vec3 ab = cross(a, b), cd = cross(c, d);
  const double a2 = norm2(a), b2 = norm2(b), c2 = norm2(c), d2 = norm2(d);
  const double far2 = std::max(std::max(a2, b2), std::max(c2, d2));
  return a2 * dot(b, cd) - b2 * dot(a, cd) + c2 * dot(d, ab) - d2 * dot(c, ab) >
         -kOnSphere * far2 * far2 * std::sqrt(far2);
}

void IdSet::grow() {
  std::vector<Slot> old(2 * slots_.size());
  old.swap(slots_);
  for (const Slot& s : old)
    if (!is_free(s)) slots_[find(s.id)] = s;
}

DelaunayCavity::DelaunayCavity(const TetMesh& mesh) : mesh_(mesh) {}

bool DelaunayCavity::is_first(TetId t) const {
  return std::find(first_.begin(), first_.end(), t) != first_.end();
}

/// Of the tets that are still taken, keeps those reached from the first ones.
void DelaunayCavity::keep_connected() {
  connected_ = first_;
  marked_.clear();
  for (const TetId t : first_) marked_.insert(t);
  for (std::size_t i = 0; i < connected_.size(); ++i)
    for (const FaceLink link : mesh_.links[connected_[i]])
      if (link.is_tet() && taken_.contains(link.tet()) && marked_.insert(link.tet()))
        connected_.push_back(link.tet());
  for (TetId t : tets_)
    if (!marked_.contains(t)) taken_.erase(t);
  tets_.swap(connected_);
}

bool DelaunayCavity::encloses_vertex(const Cavity& cavity) {
  marked_.clear();
  for (const NewTet& t : cavity.tets)
    for (int k = 0; k < 3; ++k) marked_.insert(t.v[std::size_t(k)]);
  for (TetId t : tets_)
    for (VertexId v : mesh_.tets[t])
      if (!marked_.contains(v)) return true;
  return false;
}

}  // namespace cavea
