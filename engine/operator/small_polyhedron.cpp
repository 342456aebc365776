#include "cavea/operator/small_polyhedron.h"

#include <algorithm>
#include <bit>

#include "cavea/geometry/quality.h"

namespace cavea {
namespace {

/// Tets that one search tries, so that no cavity costs more than some hundred microseconds.
constexpr int kMaxNodes = 400;

constexpr int kN = SmallPolyhedron::kMaxVertices;

/// Position of the sorted triple a < b < c in the order of c, then b, then a: vertices that come
/// later leave the numbers of the faces before them as they are.
constexpr int rank(int a, int b, int c) { return c * (c - 1) * (c - 2) / 6 + b * (b - 1) / 2 + a; }

using Triples = std::array<std::array<std::uint8_t, 3>, std::size_t(rank(0, 1, kN))>;
constexpr Triples kTriples = [] {
  Triples t{};
  for (int c = 2, i = 0; c < kN; ++c)
    for (int b = 1; b < c; ++b)
      for (int a = 0; a < b; ++a, ++i)
        t[std::size_t(i)] = {std::uint8_t(a), std::uint8_t(b), std::uint8_t(c)};
  return t;
}();

}  // namespace

SmallPolyhedron::Side SmallPolyhedron::side(int a, int b, int c) {
  const int low = std::min({a, b, c}), high = std::max({a, b, c});
  const bool odd = (a > b) ^ (b > c) ^ (a > c);
  return {std::uint8_t(rank(low, a + b + c - low - high, high)), std::int8_t(odd ? -1 : 1)};
}

std::array<std::uint8_t, 3> SmallPolyhedron::corners(Side s) {
  const auto& t = kTriples[s.face];
  return s.sign > 0 ? t : std::array<std::uint8_t, 3>{t[0], t[2], t[1]};
}

std::array<SmallPolyhedron::Side, 3> SmallPolyhedron::other_faces(
    int x, const std::array<std::uint8_t, 3>& t) {
  return {side(x, t[2], t[1]), side(x, t[0], t[2]), side(x, t[1], t[0])};
}

int SmallPolyhedron::faces() const { return rank(0, 1, vertices_); }

void SmallPolyhedron::clear() { vertices_ = 0; }

int SmallPolyhedron::add_vertex(const Vec3& point) {
  const int d = vertices_, before = faces();
  points_[std::size_t(d)] = point;
  ++vertices_;
  std::fill(chain_.begin() + before, chain_.begin() + faces(), std::int8_t(0));
  for (int f = 0; f < before; ++f) {
    const auto [a, b, c] = kTriples[std::size_t(f)];
    const float q = float(tet_quality(point, points_[a], points_[b], points_[c]));
    quality_[std::size_t(f)][std::size_t(d)] = q;
    quality_[side(b, c, d).face][a] = -q;
    quality_[side(a, c, d).face][b] = q;
    quality_[side(a, b, d).face][c] = -q;
  }
  return d;
}

void SmallPolyhedron::add_tet(const Tet& t) {
  const auto [a, b, c, d] = t;
  for (const Side s : {side(b, c, d), side(a, d, c), side(a, b, d), side(a, c, b)})
    chain_[s.face] = std::int8_t(chain_[s.face] + s.sign);
}

std::uint32_t SmallPolyhedron::boundary() const {
  std::uint32_t bits = 0;
  for (int f = 0; f < faces(); ++f)
    if (chain_[std::size_t(f)] != 0)
      for (const int v : kTriples[std::size_t(f)]) bits |= 1u << v;
  return bits;
}

float SmallPolyhedron::best_on(int face) const {
  float best = 0;
  const float sign = chain_[std::size_t(face)];
  const auto& t = kTriples[std::size_t(face)];
  for (int x = 0; x < vertices_; ++x)
    if (x != t[0] && x != t[1] && x != t[2])
      best = std::max(best, sign * quality_[std::size_t(face)][std::size_t(x)]);
  return best;
}

float SmallPolyhedron::ceiling(int a, int b, int c) const { return best_on(side(a, b, c).face); }

float SmallPolyhedron::ceiling() const {
  float lowest = 1;
  for (int f = 0; f < faces(); ++f)
    if (chain_[std::size_t(f)] != 0) lowest = std::min(lowest, best_on(f));
  return lowest;
}

/// The other faces of a tet are new, or meet an open face from its inner side.
bool SmallPolyhedron::fits(const std::array<Side, 3>& others) const {
  for (const Side s : others)
    if (const int open = chain_[s.face]; open != 0 && open != s.sign) return false;
  return true;
}

SmallPolyhedron::Candidates SmallPolyhedron::candidates(int face) const {
  Candidates found;
  const Side base{std::uint8_t(face), chain_[std::size_t(face)]};
  const auto t = corners(base);
  for (int x = 0; x < vertices_; ++x) {
    const float quality = float(base.sign) * quality_[std::size_t(face)][std::size_t(x)];
    if (x == t[0] || x == t[1] || x == t[2] || quality <= bound_) continue;
    if (fits(other_faces(x, t))) found.of[std::size_t(found.size++)] = {quality, std::uint8_t(x)};
  }
  return found;
}

/// The open face with the fewest candidates; -1 where none is open.
int SmallPolyhedron::most_constrained_face(Candidates& fewest) const {
  int best = -1;
  for (int i = 0; i < front_size_; ++i) {
    const int face = front_[std::size_t(i)];
    if (chain_[std::size_t(face)] == 0 || chain_[std::size_t(face)] == kClosed) continue;
    const Candidates here = candidates(face);
    if (best >= 0 && here.size >= fewest.size) continue;
    best = face;
    fewest = here;
    if (here.size == 0) break;
  }
  return best;
}

void SmallPolyhedron::branch(int face, const Candidate& candidate, float worst) {
  const auto base = corners({std::uint8_t(face), chain_[std::size_t(face)]});
  const auto others = other_faces(candidate.apex, base);
  const std::int8_t before = chain_[std::size_t(face)];
  const int front_before = front_size_;
  chain_[std::size_t(face)] = kClosed;
  for (const Side s : others) {
    const bool opens = chain_[s.face] == 0;
    chain_[s.face] = opens ? std::int8_t(-s.sign) : kClosed;
    if (opens) front_[std::size_t(front_size_++)] = s.face;
  }
  tets_[std::size_t(size_++)] = {candidate.apex, base[0], base[1], base[2]};
  descend(std::min(worst, candidate.quality));
  --size_;
  for (const Side s : others) chain_[s.face] = chain_[s.face] == kClosed ? s.sign : std::int8_t(0);
  chain_[std::size_t(face)] = before;
  front_size_ = front_before;
}

void SmallPolyhedron::descend(float worst) {
  if (nodes_ <= 0 || size_ == kMaxTets) return;
  --nodes_;
  Candidates candidates;
  const int face = most_constrained_face(candidates);
  if (face < 0) return complete(worst);
  std::sort(candidates.of.begin(), candidates.of.begin() + candidates.size,
            [](const Candidate& a, const Candidate& b) {
              return a.quality != b.quality ? a.quality > b.quality : a.apex < b.apex;
            });
  for (int i = 0; i < candidates.size && candidates.of[std::size_t(i)].quality > bound_; ++i)
    if (worst > bound_) branch(face, candidates.of[std::size_t(i)], worst);
}

void SmallPolyhedron::complete(float worst) {
  std::uint32_t used = 0;
  for (int i = 0; i < size_; ++i)
    for (const int v : tets_[std::size_t(i)]) used |= 1u << v;
  if ((needed_ & ~used) != 0 || std::popcount(used) < vertices_ - 1) return;
  bound_ = worst;
  best_ = tets_;
  best_size_ = size_;
}

bool SmallPolyhedron::search(float threshold, std::uint32_t kept) {
  front_size_ = size_ = best_size_ = 0;
  for (int f = 0; f < faces(); ++f)
    if (chain_[std::size_t(f)] != 0) front_[std::size_t(front_size_++)] = std::uint8_t(f);
  bound_ = threshold;
  needed_ = kept | boundary();
  nodes_ = kMaxNodes;
  descend(1);
  return best_size_ > 0;
}

}  // namespace cavea
