#pragma once
#include <fmt/format.h>

#include <utility>

#include "cavea/base/parallel.h"
#include "cavea/mesh/check.h"

namespace cavea {

/// Collects what check() finds in a range of entities.
class Findings {
 public:
  /// More would bury the first cause under its consequences.
  static constexpr std::size_t kMaxExamples = 10;

  template <class... Args>
  void add(fmt::format_string<Args...> text, Args&&... args) {
    ++result_.count;
    if (result_.examples.size() < kMaxExamples)
      result_.examples.push_back(fmt::format(text, std::forward<Args>(args)...));
  }
  void add(const CheckResult& other) {
    result_.count += other.count;
    for (const std::string& e : other.examples)
      if (result_.examples.size() < kMaxExamples) result_.examples.push_back(e);
  }
  const CheckResult& result() const { return result_; }

 private:
  CheckResult result_;
};

/// Calls inspect(i, findings) for each i in [0, n); the findings are in the order of i.
template <class Inspect>
CheckResult inspect_all(std::size_t n, Inspect&& inspect) {
  return parallel_reduce(
      n, CheckResult{},
      [&](std::size_t begin, std::size_t end) {
        Findings findings;
        for (std::size_t i = begin; i < end; ++i) inspect(i, findings);
        return findings.result();
      },
      [](const CheckResult& a, const CheckResult& b) {
        Findings sum;
        sum.add(a);
        sum.add(b);
        return sum.result();
      });
}

/// The parts of check(), each presupposing that the ones before found nothing: sound indices first,
/// so that the others may follow them.
CheckResult check_arrays(const TetMesh& mesh);
CheckResult check_indices(const TetMesh& mesh);
CheckResult check_tets(const TetMesh& mesh, const CheckOptions& options);
CheckResult check_cuts(const TetMesh& mesh);
CheckResult check_triangles(const TetMesh& mesh);
/// Edges of the surface, and the tags of vertices that follow from them.
CheckResult check_surface(const TetMesh& mesh);

}  // namespace cavea
