#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "cavea/base/ids.h"
#include "cavea/base/parallel.h"
#include "cavea/io/format.h"
#include "cavea/io/medit.h"

// Reading of Medit files, ASCII and binary alike. A File (MeditText, MeditBytes) knows its sections
// and hands out cursors that yield one number after the other; all that is here is the same for
// both.
namespace cavea::medit {

/// A section as found in a file; byte offsets into the file.
struct Section {
  const Keyword* keyword = nullptr;  ///< null if it is none of the mesh's
  std::string name;
  std::size_t at = 0;              ///< the keyword itself
  std::int64_t count = -1;         ///< announced number of rows; -1 if it makes no sense
  std::size_t begin = 0, end = 0;  ///< what follows the count
};

/// Rows of a section that one task reads.
struct Block {
  std::size_t at = 0, end = 0;  ///< byte offsets of its first number and of the section's end
  std::size_t first_row = 0, last_row = 0;
  std::size_t skip = 0;  ///< numbers before its first row: they belong to the block before
};

/// What is wrong, at a byte offset. Cursors throw it inside a task; File::fail() makes an
/// InputError of it, when it is known to be the first.
struct Fault {
  std::size_t at;
  std::string text;
};

/// Indices are stored in 32 bits, whatever a file may announce.
inline constexpr std::int64_t kLargestIndex = std::numeric_limits<std::int32_t>::max();

/// Number of entities that indices may refer to.
class Limits {
 public:
  explicit Limits(const std::vector<Section>& sections) {
    for (const Section& s : sections)
      if (s.keyword) set(s.keyword->id, s.count);
    count_[std::size_t(Target::tangent)] = kLargestIndex;  // see drop_lost_tangents()
  }
  std::int64_t operator[](Target t) const { return count_[std::size_t(t)]; }

 private:
  void set(SectionId id, std::int64_t count) {
    const std::optional<Target> target = target_of(id);
    if (target) count_[std::size_t(*target)] = std::min(count, kLargestIndex);
  }
  static std::optional<Target> target_of(SectionId id) {
    switch (id) {
      case SectionId::vertices:
        return Target::vertex;
      case SectionId::edges:
        return Target::edge;
      case SectionId::triangles:
        return Target::triangle;
      case SectionId::tets:
        return Target::tet;
      case SectionId::normals:
        return Target::normal;
      default:
        return std::nullopt;
    }
  }

  std::array<std::int64_t, kTargets> count_{};
};

constexpr std::string_view name_of(Target t) {
  constexpr std::string_view kNames[kTargets] = {"vertex",      "edge",   "triangle",
                                                 "tetrahedron", "normal", "tangent"};
  return kNames[std::size_t(t)];
}

/// Reads rows of one section; Cursor yields the numbers.
template <class Cursor>
class RowReader {
 public:
  RowReader(Cursor& in, const std::array<Target, 4>& targets, const Limits& limits)
      : in_(in), targets_(targets), limits_(limits) {}

  void read(double& x) {
    x = in_.real();
    if (!std::isfinite(x)) in_.fail("a number is not finite");
  }
  void read(Vec3& p) {
    read(p.x);
    read(p.y);
    read(p.z);
  }
  void read(std::int32_t& index) { read_index(index, targets_[0]); }
  template <std::size_t N>
  void read(std::array<std::int32_t, N>& row) {
    for (std::size_t k = 0; k < N; ++k) read_index(row[k], targets_[k]);
  }
  void read_ref(std::int32_t& ref) {
    const std::int64_t wide = in_.integer();
    ref = static_cast<std::int32_t>(wide);
    if (ref != wide) in_.fail(fmt::format("reference {} does not fit into 32 bits", wide));
  }

 private:
  void read_index(std::int32_t& index, Target target) {
    const std::int64_t wide = in_.integer();
    if (wide < 1 || wide > limits_[target]) refuse(wide, target);
    index = static_cast<std::int32_t>(wide - 1);
  }
  [[noreturn]] void refuse(std::int64_t index, Target target) {
    if (limits_[target] <= 0)
      in_.fail(fmt::format("{} {} does not exist: the file has none", name_of(target), index));
    in_.fail(fmt::format("{} {} is not in 1..{}", name_of(target), index, limits_[target]));
  }

  Cursor& in_;
  const std::array<Target, 4>& targets_;
  const Limits& limits_;
};

/// Reads one block; returns what is wrong with it, if anything is.
template <class Cursor, class Rows, class Refs>
std::optional<Fault> read_block(Cursor& in, const Block& block, std::string_view entity,
                                const std::array<Target, 4>& targets, const Limits& limits,
                                Rows& rows, Refs refs) {
  std::size_t i = block.first_row;
  try {
    for (std::size_t k = 0; k < block.skip; ++k) in.skip();
    RowReader<Cursor> reader(in, targets, limits);
    for (; i < block.last_row; ++i) {
      reader.read(rows[i]);
      if constexpr (!std::is_null_pointer_v<Refs>) reader.read_ref((*refs)[i]);
    }
  } catch (Fault& fault) {
    return Fault{fault.at, fmt::format("{} {}: {}", entity, i + 1, fault.text)};
  }
  return std::nullopt;
}

/// Reads all rows of a section, in parallel; the first fault in the file is the one that is thrown.
template <class File, class Rows, class Refs>
void read_rows(const File& file, const Section& s, std::string_view entity,
               const std::array<Target, 4>& targets, const Limits& limits, Rows& rows, Refs refs) {
  constexpr bool kWithRefs = !std::is_null_pointer_v<Refs>;
  // blocks() has seen that the file holds as many numbers as it announces: only now allocate.
  const std::vector<Block> blocks = file.blocks(s, layout_of(rows.data(), kWithRefs));
  rows.resize(std::size_t(s.count));
  if constexpr (kWithRefs) refs->resize(std::size_t(s.count));
  std::vector<std::optional<Fault>> faults(blocks.size());
  parallel_tasks(blocks.size(), [&](std::size_t k) {
    file.visit(blocks[k], [&](auto& cursor) {
      faults[k] = read_block(cursor, blocks[k], entity, targets, limits, rows, refs);
    });
  });
  for (const std::optional<Fault>& fault : faults)
    if (fault) file.fail(fault->at, fault->text);
}

template <class File>
void read_section(const File& file, const Section& s, const Limits& limits, MeshData& data) {
  const std::int64_t most = s.keyword->id == SectionId::tets ? kMaxTets : kLargestIndex;
  if (s.count > most)
    file.fail(s.at, fmt::format("{} announces {} entities; more than {} cannot be", s.name, s.count,
                                most));
  visit_section(s.keyword->id, data, [&](auto& rows, auto refs) {
    read_rows(file, s, s.keyword->entity, s.keyword->targets, limits, rows, refs);
  });
}

/// Adds one warning for each name of a section that is not read.
inline void warn_of_skipped(const std::string& file, const std::vector<Section>& sections,
                            std::vector<std::string>& warnings) {
  std::map<std::string, std::int64_t> skipped;  // by name, so that the order is the same every time
  for (const Section& s : sections)
    if (!s.keyword) skipped[s.name] += std::max<std::int64_t>(s.count, 0);
  for (const auto& [name, count] : skipped)
    warnings.push_back(
        is_other_cell(name)
            ? fmt::format("{}: {} {} ignored: only tetrahedra are read", file, count, name)
            : fmt::format("{}: keyword {} ({} entries) is not understood and skipped", file, name,
                          count));
}

constexpr bool is_essential(SectionId id) {
  return id == SectionId::vertices || id == SectionId::tets;
}

/// The names of the sections of a file, as far as a message has room for them.
template <class File>
std::string names_of_sections(const File& file) {
  constexpr std::size_t kMost = 8;
  const auto& sections = file.sections();
  std::string names;
  for (std::size_t i = 0; i < std::min(kMost, sections.size()); ++i)
    names += (i > 0 ? ", " : "") + std::string(sections[i].name);
  return sections.empty() ? "none" : sections.size() > kMost ? names + ", ..." : names;
}

/// Refuses a mesh whose main sections are missing or empty, or that gives a section twice.
template <class File>
void check_sections(const File& file) {
  std::vector<bool> seen(keywords().size());
  for (const Section& s : file.sections()) {
    if (!s.keyword) continue;
    auto before = seen[std::size_t(s.keyword->id)];
    if (before) file.fail(s.at, fmt::format("the keyword {} is given twice", s.name));
    before = true;
    if (s.count == 0 && is_essential(s.keyword->id))
      file.fail(s.at, fmt::format("the file has no {} (the count is zero)", s.name));
  }
  for (const Keyword& k : keywords())
    if (is_essential(k.id) && !seen[std::size_t(k.id)])
      file.fail_whole(
          fmt::format("the file has no section {}; it has {}", k.name, names_of_sections(file)));
}

/// mmg3d 5.8 writes wrong tangent indices into binary files, so they alone are no reason to refuse
/// a mesh: where one is out of range, the tangents go, with a warning.
inline void drop_lost_tangents(const std::string& file, MeshData& data,
                               std::vector<std::string>& warnings) {
  const auto lost = [&](const auto& pair) { return std::size_t(pair[1]) >= data.tangents.size(); };
  if (std::none_of(data.tangent_at_vertices.begin(), data.tangent_at_vertices.end(), lost)) return;
  data.tangents.clear();
  data.tangent_at_vertices.clear();
  warnings.push_back(fmt::format(
      "{}: TangentAtVertices refers to tangents that do not exist; the tangents are skipped",
      file));
}

/// \param warnings may be null.
template <class File>
MeshData read_medit(const File& file, std::vector<std::string>* warnings) {
  check_sections(file);
  const Limits limits(file.sections());
  MeshData data;
  for (const Section& s : file.sections())
    if (s.keyword) read_section(file, s, limits, data);
  std::vector<std::string> unwanted;
  std::vector<std::string>& told = warnings ? *warnings : unwanted;
  warn_of_skipped(file.name(), file.sections(), told);
  drop_lost_tangents(file.name(), data, told);
  return data;
}

/// The section of the sizes, moved on past its header; refuses whatever is not one scalar field.
template <class File>
Section scalar_section(const File& file) {
  const Section* found = nullptr;
  for (const Section& s : file.sections()) {
    if (s.name != kSolutionName) continue;
    if (found) file.fail(s.at, fmt::format("the keyword {} is given twice", s.name));
    found = &s;
  }
  if (!found) file.fail_whole(fmt::format("the file has no section {}", kSolutionName));
  Section s = *found;
  if (s.count < 0) file.fail(s.at, fmt::format("{} announces no count that can be", s.name));
  const std::int64_t fields = file.take_small_integer(s);
  if (fields != 1)
    file.fail(s.at, fmt::format("{} holds {} fields; sizes are one", s.name, fields));
  const std::int64_t type = file.take_small_integer(s);
  if (type != kScalar)
    file.fail(s.at, fmt::format("{} holds a field of {}; sizes are scalars", s.name,
                                type == kVector   ? "vectors"
                                : type == kTensor ? "tensors (an anisotropic metric)"
                                                  : fmt::format("unknown type {}", type)));
  return s;
}

template <class File>
std::vector<double> read_solution(const File& file, std::size_t expected_count, SolutionKind kind) {
  const Section s = scalar_section(file);
  std::vector<double> sizes;
  read_rows(file, s, "size of vertex", {}, Limits(file.sections()), sizes, nullptr);
  if (sizes.size() != expected_count)
    file.fail(s.at, fmt::format("{} holds {} sizes for the mesh's {} vertices", s.name,
                                sizes.size(), expected_count));
  for (std::size_t v = 0; v < sizes.size() && kind == SolutionKind::kSizes; ++v)
    if (!(sizes[v] > 0))
      file.fail(s.at, fmt::format("size of vertex {}: {} is not positive", v + 1, sizes[v]));
  return sizes;
}

}  // namespace cavea::medit
