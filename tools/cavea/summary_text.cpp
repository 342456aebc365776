#include "summary_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "text_table.h"

namespace cavea::program {
namespace {

using Figure = std::function<std::string(const MeshSummary&)>;

void add_row(TextTable& table, const std::string& label, const std::vector<SummaryColumn>& columns,
             const Figure& figure) {
  std::vector<std::string> cells = {label};
  for (const SummaryColumn& column : columns) cells.push_back(figure(*column.summary));
  table.row(std::move(cells));
}

void add_titles(TextTable& table, const std::string& label,
                const std::vector<SummaryColumn>& columns, const std::vector<std::string>& more) {
  std::vector<std::string> cells = {label};
  for (const SummaryColumn& column : columns) {
    cells.push_back(column.title);
    cells.insert(cells.end(), more.begin(), more.end());
  }
  table.row(std::move(cells));
}

Figure count_of(std::int64_t Counts::*member) {
  return [member](const MeshSummary& s) { return grouped(s.counts.*member); };
}

Figure quality_of(double QualityStatistics::*member, const char* format) {
  return [=](const MeshSummary& s) { return fmt::format(fmt::runtime(format), s.quality.*member); };
}

/// A figure about lengths, or a dash where no sizes are known.
Figure length_of(const std::function<double(const LengthStatistics&)>& get, const char* format) {
  return [=](const MeshSummary& s) {
    return s.lengths.edges ? fmt::format(fmt::runtime(format), get(s.lengths)) : std::string("-");
  };
}

template <std::size_t N>
std::string histogram_text(
    const std::string& title, const std::vector<SummaryColumn>& columns,
    const std::function<std::string(std::size_t)>& bin,
    const std::function<std::array<std::int64_t, N>(const MeshSummary&)>& get) {
  TextTable table;
  add_titles(table, title, columns, {""});
  for (std::size_t i = 0; i < N; ++i) {
    std::vector<std::string> cells = {bin(i)};
    for (const SummaryColumn& column : columns) {
      const auto counts = get(*column.summary);
      const auto total = std::accumulate(counts.begin(), counts.end(), std::int64_t{0});
      cells.push_back(total ? grouped(counts[i]) : "-");
      cells.push_back(total ? fmt::format("{:.1f} %", 100.0 * static_cast<double>(counts[i]) /
                                                          static_cast<double>(total))
                            : "");
    }
    table.row(std::move(cells));
  }
  return table.text();
}

}  // namespace

std::string figures_text(const std::vector<SummaryColumn>& columns) {
  TextTable t;
  const auto row = [&](const std::string& label, const Figure& figure) {
    add_row(t, label, columns, figure);
  };
  if (columns.size() > 1) add_titles(t, "", columns, {});
  row("vertices", count_of(&Counts::vertices));
  row("tets", count_of(&Counts::tets));
  row("triangles", count_of(&Counts::triangles));
  row("ridge edges", count_of(&Counts::ridges));
  row("corners", count_of(&Counts::corners));
  row("components", count_of(&Counts::components));
  row("boundary components", count_of(&Counts::boundary_components));
  row("volume", [](const MeshSummary& s) { return fmt::format("{:.6g}", s.counts.volume); });
  row("worst quality", quality_of(&QualityStatistics::worst, "{:.4f}"));
  row("mean quality", quality_of(&QualityStatistics::mean, "{:.4f}"));
  row("smallest dihedral angle", quality_of(&QualityStatistics::smallest_dihedral, "{:.2f}"));
  row("largest dihedral angle", quality_of(&QualityStatistics::largest_dihedral, "{:.2f}"));
  const auto has_lengths = [](const SummaryColumn& c) { return c.summary->lengths.edges > 0; };
  if (std::none_of(columns.begin(), columns.end(), has_lengths)) return t.text();
  row("shortest length", length_of([](const auto& l) { return l.shortest; }, "{:.4g}"));
  row("mean length", length_of([](const auto& l) { return l.mean; }, "{:.4g}"));
  row("longest length", length_of([](const auto& l) { return l.longest; }, "{:.4g}"));
  row("conforming lengths",
      length_of([](const auto& l) { return l.conforming_percent(); }, "{:.2f} %"));
  return t.text();
}

std::string quality_histogram_text(const std::vector<SummaryColumn>& columns) {
  return histogram_text<10>(
      "quality", columns,
      [](std::size_t i) {
        const auto low = static_cast<double>(i) / 10;
        return fmt::format("{:.1f} - {:.1f}", low, low + 0.1);
      },
      [](const MeshSummary& s) { return s.quality.histogram; });
}

std::string length_histogram_text(const std::vector<SummaryColumn>& columns) {
  return histogram_text<kLengthBins.size() + 1>(
      "length", columns,
      [](std::size_t i) {
        if (i == kLengthBins.size()) return fmt::format("{:.2f} -", kLengthBins.back());
        return fmt::format("{:.2f} - {:.2f}", i ? kLengthBins[i - 1] : 0.0, kLengthBins[i]);
      },
      [](const MeshSummary& s) { return s.lengths.histogram; });
}

}  // namespace cavea::program
