#include "cavea/part/extract.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <span>
#include <tuple>
#include <utility>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

constexpr std::int32_t kShared = -2, kUnseen = -3;

/// The part of each vertex, kIdle or kShared.
std::vector<std::int32_t> vertex_parts(const TetMesh& mesh,
                                       const std::vector<std::int32_t>& labels) {
  std::vector<std::int32_t> part(mesh.points.size(), kUnseen);
  parallel_for(mesh.tets.size(), [&](std::size_t t) {
    if (!mesh.tet_alive(TetId(t))) return;
    for (VertexId v : mesh.tets[t]) {
      std::atomic_ref ref(part[v]);
      std::int32_t seen = ref.load(std::memory_order_relaxed);
      while (seen != labels[t] && seen != kShared) {
        const std::int32_t wanted = seen == kUnseen ? labels[t] : kShared;
        if (ref.compare_exchange_weak(seen, wanted, std::memory_order_relaxed)) break;
      }
    }
  });
  return part;
}

/// Where an item is: its key, and its position in the group of that key.
struct Place {
  std::int32_t key = kIdle, local = kNone;
};

/// The members of each key's group, ascending, and the place of each item: a counting sort whose
/// blocks keep their order. Negative keys have no groups.
class Groups {
 public:
  Groups(const std::vector<std::int32_t>& key, int keys)
      : places_(key.size()), keys_(std::size_t(keys)), first_(keys_ + 1, 0) {
    // Few blocks, as each has counters for all keys.
    const std::size_t block = std::max(kReduceBlock, 16 * keys_);
    const std::size_t blocks = (key.size() + block - 1) / block;
    std::vector<std::uint32_t> next(blocks * keys_, 0);
    auto for_block = [&](std::size_t b, auto&& work) {
      for (std::size_t i = b * block; i < std::min(key.size(), (b + 1) * block); ++i)
        work(i, next.data() + b * keys_);
    };
    parallel_tasks(blocks, [&](std::size_t b) {
      for_block(b, [&](std::size_t i, std::uint32_t* counters) {
        if (key[i] >= 0) ++counters[key[i]];
      });
    });
    std::uint32_t total = 0;
    for (std::size_t k = 0; k < keys_; ++k) {
      for (std::size_t b = 0; b < blocks; ++b) total += std::exchange(next[b * keys_ + k], total);
      first_[k + 1] = total;
    }
    members_.resize(total);
    parallel_tasks(blocks, [&](std::size_t b) {
      for_block(b, [&](std::size_t i, std::uint32_t* counters) {
        places_[i].key = key[i];
        if (key[i] < 0) return;
        std::uint32_t& at = counters[key[i]];
        places_[i].local = std::int32_t(at - first_[std::size_t(key[i])]);
        members_[at++] = std::uint32_t(i);
      });
    });
  }

  std::span<const std::uint32_t> of(std::size_t key) const {
    return {members_.data() + first_[key], first_[key + 1] - first_[key]};
  }
  /// Together, as who asks for the one mostly asks for the other.
  Place place(std::int32_t item) const { return places_[item]; }

 private:
  std::vector<Place> places_;
  std::size_t keys_;
  std::vector<std::uint32_t> first_, members_;
};

/// What all parts are extracted from.
struct Whole {
  const TetMesh& mesh;
  Groups tets, vertices;
  /// Local id of each triangle in the part of each of its sides.
  std::vector<std::array<TriangleId, 2>> local_triangle;
  /// For cut k of each part: the codes of its face and of the one behind.
  std::vector<std::vector<std::array<std::int32_t, 2>>> cut_faces;
};

/// The local ids of a part's shared vertices: an open hash table.
class SharedIds {
 public:
  /// The different ones of the vertices, ascending. They have ids from `first` on. \pre called once
  std::vector<VertexId> take(const std::vector<VertexId>& vertices, VertexId first) {
    table_.assign(std::bit_ceil(vertices.size() + 1), {});
    shift_ = 32 - int(std::bit_width(table_.size() - 1));
    std::vector<VertexId> different;
    for (const VertexId v : vertices) {
      Entry& entry = table_[place_of(v)];
      if (entry.vertex == v) continue;
      entry.vertex = v;
      different.push_back(v);
    }
    std::sort(different.begin(), different.end());
    for (const VertexId v : different) table_[place_of(v)].local = first++;
    return different;
  }
  VertexId operator[](VertexId v) const { return table_[place_of(v)].local; }

 private:
  struct Entry {
    VertexId vertex = kNone, local = kNone;
  };
  /// Where the vertex is, or belongs; there is always an empty entry.
  std::size_t place_of(VertexId v) const {
    constexpr std::uint32_t kGoldenRatio = 0x9e3779b9;  // Knuth's multiplicative hashing
    std::size_t i = shift_ < 32 ? (std::uint32_t(v) * kGoldenRatio) >> shift_ : 0;
    while (table_[i].vertex != v && table_[i].vertex != kNone) i = (i + 1) & (table_.size() - 1);
    return i;
  }

  std::vector<Entry> table_;
  int shift_ = 32;
};

class Extraction {
 public:
  Extraction(Whole& whole, int number, Part& part)
      : whole_(whole), number_(number), part_(part), tets_(whole.tets.of(std::size_t(number))) {}

  void run() {
    take_vertices();
    take_tets();
    take_triangles();
    link_tets();
    point_vertices_to_tets();
    part_.tets.assign(tets_.begin(), tets_.end());
  }

 private:
  bool here(FaceLink side) const { return !local_face(side).is_unset(); }
  /// The face in this part, unset if it is none of its own.
  FaceLink local_face(FaceLink side) const {
    if (!side.is_tet()) return FaceLink();
    const Place place = whole_.tets.place(side.tet());
    return place.key == number_ ? FaceLink::to_tet(place.local, side.face()) : FaceLink();
  }
  VertexId local_vertex(VertexId v) const {
    const Place place = whole_.vertices.place(v);
    if (place.key != kShared) return place.local;
    return shared_ids_[v];
  }

  void take_vertices() {
    const auto own = whole_.vertices.of(std::size_t(number_));
    part_.own_vertices.assign(own.begin(), own.end());
    std::vector<VertexId> of_tets;
    for (std::uint32_t t : tets_)
      for (VertexId v : whole_.mesh.tets[t])
        if (whole_.vertices.place(v).key == kShared) of_tets.push_back(v);
    const auto& shared = part_.shared_vertices = shared_ids_.take(of_tets, VertexId(own.size()));
    part_.mesh.resize_vertices(own.size() + shared.size());
    for (std::size_t i = 0; i < own.size(); ++i) take_vertex(i, VertexId(own[i]), 0);
    for (std::size_t i = 0; i < shared.size(); ++i)
      take_vertex(own.size() + i, shared[i], tag::kFrozen);
  }

  void take_vertex(std::size_t to, VertexId from, Tag extra) {
    TetMesh& p = part_.mesh;
    const TetMesh& m = whole_.mesh;
    p.points[to] = m.points[from];
    p.sizes[to] = m.sizes[from];
    p.vertex_tags[to] = Tag(m.vertex_tags[from] | extra);
    p.vertex_refs[to] = m.vertex_refs[from];
    p.anchors[to] = m.anchors[from];
  }

  void take_tets() {
    TetMesh& p = part_.mesh;
    p.resize_tets(tets_.size());
    for (std::size_t i = 0; i < tets_.size(); ++i) {
      const std::uint32_t t = tets_[i];
      for (int k = 0; k < 4; ++k) p.tets[i][k] = local_vertex(whole_.mesh.tets[t][k]);
      p.qualities[i] = whole_.mesh.qualities[t];
      p.tet_refs[i] = whole_.mesh.tet_refs[t];
      p.tet_flags[i] = whole_.mesh.tet_flags[t];
    }
  }

  /// Shared triangles first, then the part's own, each group in the order of the tets.
  void take_triangles() {
    std::vector<TriangleId> own;
    for (std::uint32_t t : tets_)
      for (int f = 0; f < 4; ++f) {
        const FaceLink link = whole_.mesh.links[t][f];
        if (!link.is_triangle()) continue;
        const TriangleId id = link.triangle();
        const Triangle& s = whole_.mesh.triangles[id];
        const int side = s.sides[0] == FaceLink::to_tet(TetId(t), f) ? 0 : 1;
        const FaceLink other = s.sides[std::size_t(1 - side)];
        if (other.is_tet() && !here(other))
          part_.triangles.push_back(id);
        else if (side == 0 || !other.is_tet())
          own.push_back(id);
      }
    part_.shared_triangles = part_.triangles.size();
    for (TriangleId id : part_.triangles) take_triangle(id, tag::kFrozen);
    for (TriangleId id : own) take_triangle(id, 0);
    part_.triangles.insert(part_.triangles.end(), own.begin(), own.end());
  }

  void take_triangle(TriangleId id, Tag extra) {
    Triangle t = whole_.mesh.triangles[id];
    for (std::size_t side = 0; side < 2; ++side) {
      if (here(t.sides[side]))
        whole_.local_triangle[id][side] = TriangleId(part_.mesh.triangles.size());
      t.sides[side] = local_face(t.sides[side]);
    }
    for (VertexId& v : t.v) v = local_vertex(v);
    t.tags |= extra;
    part_.mesh.triangles.push_back(t);
  }

  void link_tets() {
    auto& cuts = whole_.cut_faces[std::size_t(number_)];
    for (std::size_t i = 0; i < tets_.size(); ++i)
      for (int f = 0; f < 4; ++f) {
        const FaceLink mine = FaceLink::to_tet(TetId(tets_[i]), f);
        const FaceLink link = whole_.mesh.links[tets_[i]][f];
        FaceLink& out = part_.mesh.links[i][f];
        if (link.is_triangle()) {
          const Triangle& s = whole_.mesh.triangles[link.triangle()];
          const std::size_t side = s.sides[0] == mine ? 0 : 1;
          out = FaceLink::to_triangle(whole_.local_triangle[link.triangle()][side]);
        } else if (out = local_face(link); out.is_unset()) {
          out = FaceLink::to_cut(std::int32_t(cuts.size()));
          cuts.push_back({mine.code(), link.code()});
        }
      }
  }

  void point_vertices_to_tets() {
    for (std::size_t i = 0; i < tets_.size(); ++i)
      for (VertexId v : part_.mesh.tets[i]) part_.mesh.vertex_tets[v] = TetId(i);
  }

  Whole& whole_;
  const std::int32_t number_;
  Part& part_;
  const std::span<const std::uint32_t> tets_;
  SharedIds shared_ids_;
};

/// Finds for each cut the cut of the other part on the same face, or the idle face.
void pair_cuts(const std::vector<std::vector<std::array<std::int32_t, 2>>>& cut_faces,
               std::vector<Part>& parts) {
  struct Cut {
    std::int32_t key, part, number;  // the key is the lower of the codes of the two faces
  };
  std::vector<std::size_t> first(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) first[p] = cut_faces[p].size();
  std::vector<Cut> cuts(exclusive_scan(first));
  parallel_tasks(parts.size(), [&](std::size_t p) {
    parts[p].partners.resize(cut_faces[p].size());
    for (std::size_t k = 0; k < cut_faces[p].size(); ++k) {
      const auto [mine, behind] = cut_faces[p][k];
      cuts[first[p] + k] = {std::min(mine, behind), std::int32_t(p), std::int32_t(k)};
    }
  });
  parallel_sort(cuts.begin(), cuts.end(), [](const Cut& a, const Cut& b) {
    return std::tie(a.key, a.part) < std::tie(b.key, b.part);
  });
  parallel_for(cuts.size(), [&](std::size_t i) {
    const Cut& a = cuts[i];
    Part::Partner& partner = parts[std::size_t(a.part)].partners[std::size_t(a.number)];
    const auto with = [&](const Cut& b) { partner = {b.part, b.number}; };
    if (i > 0 && cuts[i - 1].key == a.key)
      with(cuts[i - 1]);
    else if (i + 1 < cuts.size() && cuts[i + 1].key == a.key)
      with(cuts[i + 1]);
    else
      partner = {kIdle, cut_faces[std::size_t(a.part)][std::size_t(a.number)][1]};
  });
}

}  // namespace

std::vector<Part> extract_parts(const TetMesh& mesh, const std::vector<std::int32_t>& labels,
                                int parts) {
  Whole whole{mesh, Groups(labels, parts), Groups(vertex_parts(mesh, labels), parts),
              std::vector<std::array<TriangleId, 2>>(mesh.triangles.size(), {kNone, kNone}),
              std::vector<std::vector<std::array<std::int32_t, 2>>>(std::size_t(parts))};
  std::vector<Part> result(static_cast<std::size_t>(parts));
  parallel_tasks(result.size(), [&](std::size_t p) { Extraction(whole, int(p), result[p]).run(); });
  pair_cuts(whole.cut_faces, result);
  return result;
}

}  // namespace cavea
