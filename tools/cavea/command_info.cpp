#include "command_info.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cavea/base/error.h"
#include "cavea/io/formats.h"
#include "empty_values.h"
#include "exit_status.h"
#include "load.h"
#include "mesh_info.h"
#include "output_names.h"
#include "staging.h"
#include "summary_json.h"
#include "summary_text.h"
#include "text_table.h"

namespace cavea::program {
namespace {

Json to_json(const InfoArguments& arguments, const Info& info) {
  Json json = {{"version", CAVEA_VERSION},
               {"file", arguments.file},
               {"sound", info.violations.empty()},
               {"violations", info.violations}};
  json.update(program::to_json(info.summary));
  json["edge_lengths"] = {
      {"edges", info.euclidean.edges}, {"shortest", info.euclidean.shortest},
      {"mean", info.euclidean.mean},   {"longest", info.euclidean.longest},
      {"bins", kLengthBins},           {"histogram_over_mean", info.relative.histogram}};
  json["warnings"] = info.warnings;
  return json;
}

std::string references_text(const Counts& counts) {
  TextTable tets, triangles;
  tets.row({"reference", "tets", "volume"});
  for (const auto& [ref, number] : counts.tets_of_ref) {
    const auto volume = counts.volume_of_ref.find(ref);
    tets.row({std::to_string(ref), grouped(number),
              volume == counts.volume_of_ref.end() ? "" : fmt::format("{:.6g}", volume->second)});
  }
  triangles.row({"reference", "triangles"});
  for (const auto& [ref, number] : counts.triangles_of_ref)
    triangles.row({std::to_string(ref), grouped(number)});
  return tets.text() + "\n" + triangles.text();
}

std::string edge_lengths_text(const LengthStatistics& lengths) {
  TextTable t;
  t.row({"edges", grouped(lengths.edges)});
  t.row({"shortest edge", fmt::format("{:.6g}", lengths.shortest)});
  t.row({"mean edge", fmt::format("{:.6g}", lengths.mean)});
  t.row({"longest edge", fmt::format("{:.6g}", lengths.longest)});
  return t.text();
}

std::string to_text(const InfoArguments& arguments, const Info& info) {
  MeshSummary over_mean = info.summary;
  over_mean.lengths = info.relative;
  const std::vector<SummaryColumn> column = {{"tets", &info.summary}};
  const std::vector<SummaryColumn> lengths = {info.sizes_known
                                                  ? SummaryColumn{"over the size", &info.summary}
                                                  : SummaryColumn{"over the mean", &over_mean}};
  std::string text = fmt::format("{}\n", arguments.file) + figures_text(column) +
                     edge_lengths_text(info.euclidean) + "\n" +
                     references_text(info.summary.counts) + "\n" + quality_histogram_text(column) +
                     "\n" + length_histogram_text(lengths);
  text += info.violations.empty() ? "\n  sound\n" : "\n  NOT SOUND\n";
  for (const std::string& violation : info.violations) text += fmt::format("  {}\n", violation);
  return text;
}

void write_json(const InfoArguments& arguments, const Json& json) {
  if (arguments.json.empty()) return;
  OutputSet outputs;
  outputs.add_text(arguments.json, program::to_text(json));
  outputs.publish();
}

int report_mesh(const InfoArguments& arguments, const Info& info) {
  write_json(arguments, to_json(arguments, info));
  print_warnings(info.warnings);
  fmt::print("{}", to_text(arguments, info));
  return info.violations.empty() ? kDone : kMissed;
}

/// Lists that are no mesh at all (a face in three tets, say): readable, but not sound.
int report_no_mesh(const InfoArguments& arguments, const std::string& why) {
  write_json(arguments, {{"version", CAVEA_VERSION},
                         {"file", arguments.file},
                         {"sound", false},
                         {"violations", Json::array({why})}});
  fmt::print("{}\n  NOT SOUND\n  {}\n", arguments.file, why);
  return kMissed;
}

}  // namespace

CLI::App* add_info_command(CLI::App& app, InfoArguments& arguments) {
  CLI::App* command = app.add_subcommand("info", "Measure a mesh and say whether it is sound");
  command->add_option("FILE", arguments.file, "Mesh to read")->required();
  command->add_option("--json", arguments.json, "Write the figures as JSON");
  refuse_empty_values(*command);
  return command;
}

int run_info(const InfoArguments& arguments) {
  if (!arguments.json.empty())
    check_outputs({{"the input", arguments.file}}, {{"--json", arguments.json}});
  std::vector<std::string> warnings;
  MeshData data = read_mesh(arguments.file, &warnings);
  try {
    return report_mesh(arguments, measure(arguments.file, std::move(data), std::move(warnings)));
  } catch (const InputError& e) {
    return report_no_mesh(arguments, e.what());
  }
}

}  // namespace cavea::program
