#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "run_report.h"
#include "summary_text.h"
#include "text_table.h"

namespace cavea::program {
namespace {

constexpr double kMegabyte = 1e6;

std::string surface_text(const Report& report) {
  TextTable t;
  t.row({"surface distance", fmt::format("{:.4g}", report.surface_distance),
         fmt::format("({:.2f} of hausd {:.4g})", report.surface_distance / report.hausd,
                     report.hausd)});
  t.row({"bulge of the smooth surface", fmt::format("{:.4g}", report.bulge),
         fmt::format("({:.2f} of hausd)", report.bulge / report.hausd)});
  return t.text();
}

std::string cost_text(const RunReport& run) {
  const Report& report = run.report;
  const auto bytes = static_cast<double>(report.peak_resident_bytes);
  TextTable t;
  t.row({"time", fmt::format("{:.2f} s", report.seconds),
         fmt::format("({} threads; read {:.2f} s, write {:.2f} s)", report.threads,
                     run.read_seconds, run.write_seconds)});
  t.row({"speed",
         fmt::format("{} tets/s", grouped(static_cast<std::int64_t>(report.tets_per_second)))});
  t.row({"peak memory", fmt::format("{:.0f} MB", bytes / kMegabyte)});
  return t.text();
}

/// A number of entities in full, anything else to four digits.
std::string figure(double x) {
  return x >= 1000 && x == std::floor(x) ? fmt::format("{:.0f}", x) : fmt::format("{:.4g}", x);
}

std::string targets_text(const Report& report) {
  TextTable t;
  t.row({"target", "wanted", "measured", ""});
  for (const Target& target : report.targets)
    t.row({target.name, figure(target.wanted), figure(target.measured),
           target.met ? "met" : "MISSED"});
  return t.text();
}

std::string phases_text(const Report& report) {
  TextTable t;
  t.row({"phase", "seconds"});
  for (const PhaseTime& p : report.phases) t.row({p.phase, fmt::format("{:.2f}", p.seconds)});
  return t.text();
}

/// A line a tet: "edge_swap: 4 worse_quality, 2 breaks_feature; ...".
std::string stubborn_text(const Report& report) {
  std::string out =
      fmt::format("stubborn tetrahedra, the worst first: {}\n", report.stubborn.size());
  constexpr std::size_t kMostShown = 20;  // the JSON has all
  const std::size_t shown = std::min(report.stubborn.size(), kMostShown);
  for (const StubbornTet& t : std::span(report.stubborn).first(shown)) {
    out += fmt::format("  {:.3f} at ({:.6g}, {:.6g}, {:.6g})", t.quality, t.where.x, t.where.y,
                       t.where.z);
    if (!t.reason.empty()) out += ": " + t.reason;
    std::string op;
    for (const VerdictCount& v : t.verdicts) {
      out += v.op == op ? ", " : "\n    " + v.op + ": ";
      out += fmt::format("{} {}", v.count, v.verdict);
      op = v.op;
    }
    out += "\n";
  }
  return out;
}

std::string verdicts_text(const Report& report) {
  TextTable t;
  t.row({"operator, verdict", "count"});
  for (const VerdictCount& v : report.verdicts)
    t.row({fmt::format("{}, {}", v.op, v.verdict), grouped(v.count)});
  return t.text();
}

}  // namespace

namespace {

std::string level_set_text(const LevelSetRun& run, bool by_name) {
  const CutReport& cut = run.cut;
  std::string text =
      fmt::format("{}: {} triangles cut{}; {} components removed, {} cavities filled",
                  by_name ? run.name : "level set", cut.interface_triangles,
                  cut.open ? ", open at the boundary of the domain" : "", cut.removed_components,
                  cut.filled_cavities);
  if (run.distance)
    text += fmt::format("; after remeshing {:.4g} from the interface", *run.distance);
  return text + "\n";
}

std::string level_sets_text(const std::vector<LevelSetRun>& runs) {
  std::string text;
  for (const LevelSetRun& run : runs) text += level_set_text(run, runs.size() > 1);
  return text;
}

}  // namespace

std::string to_text(const RunReport& run, bool verbose) {
  const Report& report = run.report;
  const std::vector<SummaryColumn> columns = {{"before", &report.before}, {"after", &report.after}};
  std::vector<std::string> blocks = {
      fmt::format("cavea {}: {} -> {}\n", CAVEA_VERSION, run.arguments.input,
                  fmt::join(run.arguments.outputs, ", ")),
      figures_text(columns), quality_histogram_text(columns), length_histogram_text(columns)};
  if (verbose) {
    blocks.push_back(phases_text(report));
    blocks.push_back(verdicts_text(report));
    if (!report.stubborn.empty()) blocks.push_back(stubborn_text(report));
  }
  if (!run.level_sets.empty()) blocks.push_back(level_sets_text(run.level_sets));
  blocks.push_back(surface_text(report) + cost_text(run));
  blocks.push_back(targets_text(report));
  return fmt::format("{}", fmt::join(blocks, "\n"));
}

namespace {

/// More than these are counted on standard error; the JSON report names all.
constexpr std::size_t kMostNamed = 20;

std::string flat_text(const std::vector<FlatTet>& flat) {
  std::string out;
  for (std::size_t i = 0; i < std::min(flat.size(), kMostNamed); ++i) {
    const auto& [x, y, z] = flat[i].place;
    out += fmt::format("cavea: flat: tetrahedron {} of the output, at ({:.6g}, {:.6g}, {:.6g})\n",
                       flat[i].tet + 1, x, y, z);
  }
  if (flat.size() > kMostNamed)
    out += fmt::format("cavea: flat: and {} more; --report names all\n", flat.size() - kMostNamed);
  return out;
}

}  // namespace

std::string missed_text(const Report& report) {
  std::string out;
  for (const Target& t : report.targets)
    if (!t.met)
      out +=
          fmt::format("cavea: target missed: {}: {}, wanted {}{}{}\n", t.name, figure(t.measured),
                      figure(t.wanted), t.where.empty() ? "" : ", at ", t.where);
  return out + flat_text(report.after.quality.flat);
}

}  // namespace cavea::program
