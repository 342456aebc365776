#include "run_report.h"

namespace cavea::program {
namespace {

Json frozen_json(const Freezes& freeze) {
  Json frozen = Json::array();
  const auto add = [&](bool is_frozen, const char* what) {
    if (is_frozen) frozen.push_back(what);
  };
  add(freeze.insert, "insert");
  add(freeze.collapse, "collapse");
  add(freeze.swap, "swap");
  add(freeze.move, "move");
  add(freeze.surface, "surface");
  add(freeze.join, "join");
  return frozen;
}

Json options_json(const RunReport& run) {
  const Options& asked = run.arguments.options;
  const Report& report = run.report;
  Json options = {{"hausd", report.hausd}, {"hmin", report.hmin},   {"hmax", report.hmax},
                  {"hsiz", nullptr},       {"hgrad", report.hgrad}, {"angle", nullptr}};
  options["sol"] = nullptr;
  if (!run.arguments.sizes.empty()) options["sol"] = run.arguments.sizes;
  if (asked.hsiz) options["hsiz"] = *asked.hsiz;
  if (run.arguments.detects_ridges()) options["angle"] = run.arguments.angle.value_or(asked.angle);
  options["params"] = nullptr;
  if (!run.arguments.parameters.empty()) options["params"] = run.arguments.parameters;
  options["max_tets"] = nullptr;
  if (asked.max_tets) options["max_tets"] = *asked.max_tets;
  options["max_memory"] = nullptr;
  if (asked.max_memory) options["max_memory"] = *asked.max_memory;
  options["optim"] = asked.optim;
  options["hgradreq"] = nullptr;
  if (asked.hgradreq && !run.arguments.no_hgradreq) options["hgradreq"] = *asked.hgradreq;
  options["keep_internal"] = run.arguments.build.keep_internal;
  options["frozen"] = frozen_json(asked.freeze);
  options["min_quality"] = asked.min_quality;
  options["min_conform"] = asked.min_conform;
  return options;
}

Json phases_json(const Report& report) {
  Json phases = Json::array();
  for (const PhaseTime& p : report.phases)
    phases.push_back({{"phase", p.phase}, {"seconds", p.seconds}});
  return phases;
}

Json verdicts_json(const std::vector<VerdictCount>& counts) {
  Json verdicts = Json::object();
  for (const VerdictCount& v : counts) verdicts[v.op][v.verdict] = v.count;
  return verdicts;
}

Json residual_json(const ResidualCount& r) {
  return {{"before", r.before},   {"after", r.after},   {"regions", r.regions},
          {"changes", r.changes}, {"colors", r.colors}, {"batches", r.batches}};
}

Json stubborn_json(const Report& report) {
  Json stubborn = Json::array();
  for (const StubbornTet& t : report.stubborn)
    stubborn.push_back({{"where", {t.where.x, t.where.y, t.where.z}},
                        {"quality", t.quality},
                        {"verdicts", verdicts_json(t.verdicts)},
                        {"reason", t.reason}});
  return stubborn;
}

Json level_set_json(const LevelSetRun& run) {
  const CutReport& cut = run.cut;
  Json out = {{"name", run.name},
              {"smallest_value", cut.smallest_value},
              {"largest_value", cut.largest_value},
              {"vertices_on_interface", cut.vertices_on_interface},
              {"interface_triangles", cut.interface_triangles},
              {"removed_components", cut.removed_components},
              {"filled_cavities", cut.filled_cavities},
              {"open", cut.open},
              {"sagitta", cut.sagitta}};
  if (run.distance) out["distance"] = *run.distance;
  return out;
}

Json targets_json(const Report& report) {
  Json targets = Json::array();
  for (const Target& t : report.targets)
    targets.push_back({{"name", t.name},
                       {"wanted", t.wanted},
                       {"measured", t.measured},
                       {"met", t.met},
                       {"where", t.where}});
  return targets;
}

}  // namespace

Json to_json(const RunReport& run) {
  const Report& report = run.report;
  Json out = {{"version", CAVEA_VERSION},
              {"input", run.arguments.input},
              {"outputs", run.arguments.outputs},
              {"options", options_json(run)},
              {"threads", report.threads},
              {"seconds", report.seconds},
              {"read_seconds", run.read_seconds},
              {"write_seconds", run.write_seconds},
              {"tets_per_second", report.tets_per_second},
              {"peak_resident_bytes", report.peak_resident_bytes},
              {"phases", phases_json(report)},
              {"finer", report.finer},
              {"before", to_json(report.before)},
              {"after", to_json(report.after)},
              {"verdicts", verdicts_json(report.verdicts)},
              {"parts", report.parts},
              {"residual", residual_json(report.residual)},
              {"interface_quality",
               {{"at_interface", report.interface_quality.at_interface},
                {"elsewhere", report.interface_quality.elsewhere}}},
              {"stubborn", stubborn_json(report)},
              {"surface_distance", report.surface_distance},
              {"bulge", report.bulge},
              {"targets", targets_json(report)},
              {"targets_met", report.targets_met()},
              {"warnings", report.warnings}};
  if (run.level_sets.size() == 1) out["level_set"] = level_set_json(run.level_sets[0]);
  if (run.level_sets.size() > 1)
    for (const LevelSetRun& level_set : run.level_sets)
      out["level_sets"].push_back(level_set_json(level_set));
  return out;
}

}  // namespace cavea::program
