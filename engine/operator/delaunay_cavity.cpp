#include "cavea/operator/delaunay_cavity.h"

#include <algorithm>

namespace cavea {

DelaunayCavity::DelaunayCavity(const TetMesh& mesh)
    : mesh_(mesh), beside_(std::size_t(kMostVertices * kMostVertices)) {}

bool DelaunayCavity::is_first(TetId t) const {
  return std::find(first_.begin(), first_.end(), t) != first_.end();
}

/// Of the tets that are still taken, keeps those reached from the first ones.
void DelaunayCavity::keep_connected() {
  connected_ = first_;
  marked_.clear();
  for (const TetId t : first_) marked_[t] = 1;
  for (std::size_t i = 0; i < connected_.size(); ++i)
    for (const FaceLink link : mesh_.links[connected_[i]]) {
      if (!link.is_tet() || !contains(link.tet())) continue;
      std::int32_t& mark = marked_[link.tet()];
      if (mark == IdMap::kNew) connected_.push_back(link.tet());
      mark = 1;
    }
  for (TetId t : tets_)
    if (marked_.at(t) == IdMap::kNew) taken_[t] = kOut;
  tets_.swap(connected_);
}

void DelaunayCavity::number_vertices(const Cavity& cavity) {
  marked_.clear();
  corners_.clear();
  vertices_ = 0;
  for (const NewTet& t : cavity.tets) {
    auto& corners = corners_.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      std::int32_t& number = marked_[t.v[k]];
      if (number == IdMap::kNew) number = vertices_++;
      corners[k] = number;
    }
  }
}

bool DelaunayCavity::encloses_vertex(const Cavity& cavity) {
  number_vertices(cavity);
  return std::ranges::any_of(hidden_, [&](VertexId v) { return marked_.at(v) == IdMap::kNew; });
}

void DelaunayCavity::link(Cavity& cavity) {
  cavity.links.clear();
  if (vertices_ > kMostVertices) return;
  // Seen from the vertex, the new tets are triangles; those at an edge run along it both ways.
  const auto at = [&](std::int32_t from, std::int32_t to) -> FaceLink& {
    return beside_[std::size_t(from * kMostVertices + to)];
  };
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const auto [a, b, c] = corners_[i];
    at(b, c) = FaceLink::to_tet(TetId(i), 0);
    at(c, a) = FaceLink::to_tet(TetId(i), 1);
    at(a, b) = FaceLink::to_tet(TetId(i), 2);
  }
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const auto [a, b, c] = corners_[i];
    cavity.links.push_back({at(c, b), at(a, c), at(b, a), bases_[i]});
  }
}

}  // namespace cavea
