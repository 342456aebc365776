#include "cavea/part/seed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "cavea/base/cancel.h"
#include "cavea/base/collect.h"
#include "cavea/base/largest_first.h"
#include "cavea/base/parallel.h"
#include "cavea/cavity/mesh_editor.h"
#include "cavea/mesh/grow.h"
#include "cavea/operator/vertex_insert.h"

namespace cavea {
namespace {

/// In boxes with fewer points all are looked at.
constexpr double kFewPoints = 4096;

/// Edge of a block and what it may reach beyond, in cells. Blocks of one colour are a block apart,
/// so that reaches are disjoint; a cavity between points of the coarser level reaches 2.3 cells.
struct BlockShape {
  double edge, reach;
};
constexpr BlockShape kWide{8, 3.9}, kNarrow{5, 2.45};
constexpr int kColors = 8;

/// Fewer seeds make so few wide blocks, of up to 900, that threads would wait for each other.
constexpr std::size_t kFewSeeds = 15000;

/// A block may hold many seeds where all are inserted by one thread: a few milliseconds' work.
constexpr std::size_t kSeedsBetweenChecks = 256;

/// Tets that an insertion adds are 7 on the average in a lattice.
constexpr std::int32_t kTetsPerVertex = 8, kSpareTets = 64;
/// One of so many tets and vertices more have room in the mesh.
constexpr std::size_t kSpareShare = 16;

struct Seed {
  Vec3 point;
  float size;
  VertexId near;  ///< of the tet around it
};

/// Points that are inserted one after the other.
struct Block {
  std::size_t begin, end;
  Box reach;
  MeshEditor::Holes holes;
  std::vector<Seed> left;  ///< those that the reach forbids
  VerdictTable verdicts;
};

class SeedLevel {
 public:
  SeedLevel(TetMesh& mesh, const SeedOptions& options, int level, int coarsest)
      : mesh_(mesh),
        options_(options),
        level_(level),
        coarsest_(coarsest),
        cell_(options.lattice.cell_at(level)) {}

  VerdictTable run() {
    find_seeds();
    const BlockShape shape = seeds_.size() < kFewSeeds ? kNarrow : kWide;
    for (const double shift : {0.0, 0.5}) insert_in_blocks(shape, shift);
    insert_at_once();
    return verdicts_;
  }

 private:
  void find_seeds() {
    seeds_ = collect_in_order<Seed>(
        mesh_.tets.size(), [&](std::size_t t, auto& found) { find_seeds_in(TetId(t), found); });
  }

  void find_seeds_in(TetId t, std::vector<Seed>& out) const {
    if (!mesh_.tet_alive(t)) return;
    const auto& k = mesh_.tets[t];
    float smallest = mesh_.sizes[k[0]];
    for (VertexId v : k) smallest = std::min(smallest, mesh_.sizes[v]);
    if (cell_ < kFinestCell * smallest) return;
    throw_if_cancelled(options_.cancel);
    const std::array<Vec3, 4> tet = mesh_.corners(t);
    const Box box = box_of(tet);
    const auto offer = [&](const Vec3& p) { add_if_wanted(k, p, out); };
    const bool all = options_.size || cell_ >= kFinestCell * options_.largest;
    if (all || options_.lattice.count_in(box, level_) < kFewPoints)
      options_.lattice.for_each_inside(tet, box, level_, coarsest_, offer);
    else
      for_each_near_vertices(k, tet, box, offer);
  }

  /// Those points where the vertices ask for cells so small: in tets that are long beside them,
  /// few.
  template <class F>
  void for_each_near_vertices(const std::array<VertexId, 4>& k, const std::array<Vec3, 4>& tet,
                              const Box& box, F&& f) const {
    std::array<Box, 4> near;
    for (std::size_t i = 0; i < 4; ++i) {
      const double reach = (cell_ / kFinestCell - mesh_.sizes[k[i]]) / options_.growth;
      if (!(reach >= 0)) continue;
      near[i] = box.common(Box{tet[i], tet[i]}.widened(reach));
      options_.lattice.for_each_inside(tet, near[i], level_, coarsest_, [&](const Vec3& p) {
        const bool again = std::any_of(near.begin(), near.begin() + std::ptrdiff_t(i),
                                       [&](const Box& b) { return b.contains(p); });
        if (!again) f(p);
      });
    }
  }

  void add_if_wanted(const std::array<VertexId, 4>& k, const Vec3& p,
                     std::vector<Seed>& out) const {
    double size = options_.largest, nearest2 = std::numeric_limits<double>::infinity();
    VertexId near = kNone;
    for (VertexId v : k) {
      const double d2 = distance2(mesh_.points[v], p);
      size = std::min(size, mesh_.sizes[v] + options_.growth * std::sqrt(d2));
      if (near == kNone) near = v;
      if (mesh_.vertex_tags[v] & tag::kReplaceable) continue;  // and may be gone soon
      if (d2 < nearest2) nearest2 = d2, near = v;
    }
    if (options_.size) size = options_.size(p, size);
    const double least = VertexInsert::kNearest * size;
    if (cell_ < kFinestCell * size || nearest2 < least * least) return;
    out.push_back({p, float(size), near});
  }

  /// Sorts the seeds into blocks and inserts those of each colour at the same time; what a block's
  /// reach forbids is left.
  void insert_in_blocks(const BlockShape& shape, double shift) {
    const double edge = shape.edge * cell_;
    struct Key {
      std::int32_t color, x, y, z;
      std::uint32_t seed;
      auto block() const { return std::tie(color, x, y, z); }
    };
    std::vector<Key> keys(seeds_.size());
    parallel_for(seeds_.size(), [&](std::size_t i) {
      auto at = [&](double x) { return std::int32_t(std::floor(x / edge + shift)); };
      const Vec3& p = seeds_[i].point;
      const std::int32_t x = at(p.x), y = at(p.y), z = at(p.z);
      keys[i] = {(x & 1) | (y & 1) << 1 | (z & 1) << 2, x, y, z, std::uint32_t(i)};
    });
    parallel_sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
      return std::tuple_cat(a.block(), std::tie(a.seed)) <
             std::tuple_cat(b.block(), std::tie(b.seed));
    });
    std::vector<Seed> sorted(seeds_.size());
    parallel_for(keys.size(), [&](std::size_t i) { sorted[i] = seeds_[keys[i].seed]; });
    seeds_.swap(sorted);

    std::vector<Block> blocks;
    std::array<std::size_t, kColors + 1> first{};
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (i == 0 || keys[i].block() != keys[i - 1].block()) {
        const Vec3 low = edge * (Vec3{double(keys[i].x), double(keys[i].y), double(keys[i].z)} -
                                 Vec3{shift, shift, shift});
        const double r = shape.reach * cell_;
        const Vec3 out{r, r, r}, size{edge, edge, edge};
        blocks.push_back({i, i, Box{low - out, low + size + out}, {}, {}, {}});
        ++first[std::size_t(keys[i].color) + 1];
      }
      blocks.back().end = i + 1;
    }
    for (std::size_t c = 0; c < kColors; ++c) first[c + 1] += first[c];
    make_holes(blocks);
    for (std::size_t c = 0; c < kColors; ++c) insert_color(blocks, first[c], first[c + 1]);
    keep_left(blocks);
  }

  /// What no block could insert.
  void insert_at_once() {
    if (seeds_.empty()) return;
    std::vector<Block> all(1);
    constexpr double kFar = std::numeric_limits<double>::max();
    all[0] = {0, seeds_.size(), Box{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}, {}, {}, {}};
    make_holes(all);
    insert_color(all, 0, 1);
    keep_left(all);
  }

  void make_holes(std::vector<Block>& blocks) {
    std::size_t tets = mesh_.tets.size(), vertices = mesh_.points.size();
    for (Block& b : blocks) {
      const auto n = std::int32_t(b.end - b.begin);
      b.holes = {TetId(tets), kTetsPerVertex * n + kSpareTets, VertexId(vertices), n};
      tets += std::size_t(b.holes.tets), vertices += std::size_t(b.holes.vertices);
    }
    // What one pass leaves is little: the next one is to find room without moving all.
    grow(mesh_, tets, vertices, kSpareShare);
  }

  void insert_color(std::vector<Block>& blocks, std::size_t begin, std::size_t end) {
    const std::vector<std::size_t> order = largest_first(end - begin, [&](std::size_t i) {
      return blocks[begin + i].end - blocks[begin + i].begin;
    });
    parallel_tasks(order.size(), [&](std::size_t i) { insert_block(blocks[begin + order[i]]); });
  }

  void insert_block(Block& b) {
    MeshEditor editor(mesh_, b.holes);
    VertexInsert insert(mesh_, b.reach);
    Cavity cavity;
    VertexId last = kNone;  // that was inserted, not far from the next
    for (std::size_t i = b.begin; i < b.end; ++i) {
      const Seed& s = seeds_[i];
      if ((i - b.begin) % kSeedsBetweenChecks == 0) throw_if_cancelled(options_.cancel);
      const VertexId from = insert.is_gone(s.near) ? last : s.near;
      const TetId around = from == kNone ? kNone : insert.locate(from, s.point);
      NewVertex vertex;
      vertex.point = s.point, vertex.size = s.size;
      Verdict v =
          around == kNone ? Verdict::kFrozen : insert(vertex, editor.next_vertex(), around, cavity);
      if (v == Verdict::kAccept && !editor.fits(cavity)) v = Verdict::kFrozen;
      b.verdicts.add(Operator::kVertexInsert, v);
      if (v == Verdict::kFrozen) b.left.push_back(s);
      if (v != Verdict::kAccept) continue;
      last = editor.next_vertex();
      editor.commit(cavity);
    }
  }

  void keep_left(std::vector<Block>& blocks) {
    seeds_.clear();
    for (const Block& b : blocks) {
      seeds_.insert(seeds_.end(), b.left.begin(), b.left.end());
      verdicts_ += b.verdicts;
    }
  }

  TetMesh& mesh_;
  const SeedOptions& options_;
  const int level_, coarsest_;
  const double cell_;  ///< of the level
  std::vector<Seed> seeds_;
  VerdictTable verdicts_;
};

}  // namespace

VerdictTable seed_level(TetMesh& mesh, const SeedOptions& options, int level, int coarsest) {
  return SeedLevel(mesh, options, level, coarsest).run();
}

}  // namespace cavea
