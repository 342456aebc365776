#include "cavea/operator/delaunay_cavity.h"

#include <algorithm>
#include <numeric>

namespace cavea {

DelaunayCavity::DelaunayCavity(const TetMesh& mesh)
    : mesh_(mesh), beside_(std::size_t(kMostVertices * kMostVertices)) {}

void DelaunayCavity::restore() {
  is_in_.assign(found_.size(), true);
  order_.resize(found_.size());
  std::iota(order_.begin(), order_.end(), 0);
  tets_ = found_;
}

void DelaunayCavity::forget_qualities() {
  qualities_.assign(found_.size(), {kUnknown, kUnknown, kUnknown, kUnknown});
}

/// Of the tets that are still in, keeps those reached from the first ones.
void DelaunayCavity::keep_connected() {
  connected_.resize(first_);
  std::iota(connected_.begin(), connected_.end(), 0);
  std::fill_n(is_in_.begin(), first_, false);
  // What is reached is taken out, so that it is reached once, and what is not stays out.
  for (std::size_t i = 0; i < connected_.size(); ++i)
    for (const std::int32_t next : behind_[std::size_t(connected_[i])])
      if (is_in(next)) {
        is_in_[std::size_t(next)] = false;
        connected_.push_back(next);
      }
  std::ranges::fill(is_in_, false);
  tets_.clear();
  for (const std::int32_t i : connected_) {
    is_in_[std::size_t(i)] = true;
    tets_.push_back(found_[std::size_t(i)]);
  }
  order_.swap(connected_);
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
  const auto& removed = cavity.removed_vertices;
  return std::ranges::any_of(hidden_, [&](VertexId v) {
    return marked_.at(v) == IdMap::kNew && std::ranges::find(removed, v) == removed.end();
  });
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
