#include "cavea/part/interface_quality.h"

#include <algorithm>

#include "cavea/base/parallel.h"

namespace cavea {
namespace {

bool met_interface(const TetMesh& m, std::size_t t) {
  return std::ranges::any_of(m.tets[t],
                             [&](VertexId v) { return m.vertex_tags[v] & tag::kMetInterface; });
}

void add(InterfaceQuality::Histogram& sum, const InterfaceQuality::Histogram& more) {
  for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += more[k];
}

}  // namespace

void remember_interface(TetMesh& m) {
  parallel_for(m.vertex_tags.size(), [&](std::size_t v) {
    if (m.vertex_tags[v] & tag::kWasInterface) m.vertex_tags[v] |= tag::kMetInterface;
  });
}

void forget_interfaces(TetMesh& m) {
  parallel_for(m.vertex_tags.size(),
               [&](std::size_t v) { m.vertex_tags[v] &= Tag(~tag::kMetInterface); });
}

InterfaceQuality interface_quality(const TetMesh& m) {
  return parallel_reduce(
      m.tets.size(), InterfaceQuality{},
      [&](std::size_t begin, std::size_t end) {
        InterfaceQuality q;
        for (std::size_t t = begin; t < end; ++t) {
          auto& histogram = met_interface(m, t) ? q.at_interface : q.elsewhere;
          const auto bin = std::size_t(10 * std::max(0.0f, m.qualities[t]));
          ++histogram[std::min(bin, histogram.size() - 1)];
        }
        return q;
      },
      [](InterfaceQuality a, const InterfaceQuality& b) {
        add(a.at_interface, b.at_interface);
        add(a.elsewhere, b.elsewhere);
        return a;
      });
}

}  // namespace cavea
