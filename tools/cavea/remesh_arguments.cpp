#include "remesh_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cavea/base/error.h"
#include "empty_values.h"
#include "grid_domain.h"
#include "parameters.h"

namespace cavea::program {
namespace {

void add_size_flags(CLI::App& command, RemeshArguments& arguments, const char* sizes_flag) {
  Options& options = arguments.options;
  command.add_option(
      "--hausd", options.hausd,
      "Largest distance to the ideal surface [0.001 of the box diagonal, less of slender bodies]");
  CLI::Option* bulge = command.add_option(
      "--max-bulge", options.max_bulge,
      "Largest distance of the ideal surface from the input's triangles [3 hausd]");
  command.add_flag("--faceted", options.faceted, "The input's triangles are the ideal surface")
      ->excludes(bulge);
  command.add_option("--surface", arguments.surface,
                     "Mesh whose surface is the truth in place of that of IN");
  command.add_option("--hmin", options.hmin,
                     "Shortest wanted edge [0.001 of the box diagonal, less of slender bodies]");
  command.add_option("--hmax", options.hmax, "Longest wanted edge [0.1 of the box diagonal]");
  CLI::Option* uniform = command.add_option("--hsiz", options.hsiz, "One edge length everywhere");
  CLI::Option* sizes = command
                           .add_option(sizes_flag, arguments.sizes,
                                       "Wanted edge lengths at the vertices of IN (.sol, .solb)")
                           ->excludes(uniform);
  command
      .add_option("--params", arguments.parameters,
                  "Parameters by reference and by region (.json, .mmg3d)")
      ->excludes(uniform);
  command.add_option("--max-tets", options.max_tets,
                     "Number of tetrahedra to keep to, by larger edges where needed");
  command
      .add_option("--max-memory", options.max_memory,
                  "Refuse what is foreseen to need more bytes, as 8G [all there are]")
      ->transform(CLI::AsSizeValue(true));
  command.add_flag("--optim", options.optim, "Keep the mesh's own edge lengths")
      ->excludes(uniform)
      ->excludes(sizes);
}

void add_gradation_flags(CLI::App& command, RemeshArguments& arguments) {
  const auto add = [&](const std::string& name, std::optional<double>& value, bool& none,
                       const std::string& what) {
    CLI::Option* ratio =
        command.add_option("--" + name, value, fmt::format("{} [{}]", what, *value));
    command.add_flag("--no-" + name, none, "No bound of it")->excludes(ratio);
  };
  add("hgrad", arguments.options.hgrad, arguments.no_hgrad,
      "Largest ratio of adjacent edge lengths");
  add("hgradreq", arguments.options.hgradreq, arguments.no_hgradreq,
      "The same from required entities, which keep their lengths");
}

void add_surface_flags(CLI::App& command, RemeshArguments& arguments) {
  CLI::Option* angle = command.add_option("--angle", arguments.angle,
                                          "Angle between normals, in degrees, that makes a ridge "
                                          "[45; in a .vdb file there are none]");
  command.add_flag("--no-angle", arguments.no_angle, "Detect no ridges")->excludes(angle);
  command.add_flag("--keep-internal", arguments.build.keep_internal,
                   "Keep triangles between tetrahedra of one reference as surface");
}

void add_freeze_flags(CLI::App& command, Freezes& freeze) {
  command.add_flag("--no-insert", freeze.insert, "Insert no vertices");
  command.add_flag("--no-collapse", freeze.collapse, "Remove no vertices");
  command.add_flag("--no-swap", freeze.swap, "Swap no edges and faces");
  command.add_flag("--no-move", freeze.move, "Move no vertices");
  command.add_flag("--no-surface", freeze.surface,
                   "Leave the surface as it is; its edges' lengths are the sizes there");
  command.add_flag("--no-join", freeze.join,
                   "Do not join what of the surface is nearer to each other than hausd");
}

void add_target_flags(CLI::App& command, Options& options) {
  command
      .add_option("--min-quality", options.min_quality,
                  "Target: quality of the worst tetrahedron (a regular one has 1)")
      ->capture_default_str();
  command
      .add_option("--min-conform", options.min_conform,
                  "Target: percent of edges within [1/sqrt2, sqrt2] of the wanted length")
      ->capture_default_str();
}

void add_output_flags(CLI::App& command, RemeshArguments& arguments) {
  CLI::Option* out =
      command.add_option("-o,--out", arguments.outputs, "File to write; may be given again");
  out->required();
  one_value_each(out);
  command.add_option("--report", arguments.report, "Write a report as JSON");
  CLI::Option* verbose = command.add_flag("--verbose", arguments.verbose,
                                          "Also print the phases and the verdicts of operators");
  command.add_flag("--quiet", arguments.quiet, "Print nothing but errors and missed targets")
      ->excludes(verbose);
}

}  // namespace

namespace {

void add_common_flags(CLI::App* command, RemeshArguments& arguments, const char* sizes_flag) {
  command->add_option("IN", arguments.input, "Mesh to read")->required();
  if (arguments.implicit) add_stack_positional(*command, *arguments.implicit);
  add_output_flags(*command, arguments);
  add_size_flags(*command, arguments, sizes_flag);
  add_gradation_flags(*command, arguments);
  add_surface_flags(*command, arguments);
  add_freeze_flags(*command, arguments.options.freeze);
  add_target_flags(*command, arguments.options);
  command->add_option("--threads", arguments.threads, "Number of threads [all cores]");
  command->add_option("--tets-per-part", arguments.options.tets_per_part,
                      "Size of the parts that are run in parallel [what fits caches]");
  command->footer(
      "Exit status: 0 done, every target met; 1 a valid mesh was written, but a target was missed; "
      "2 bad usage or input, nothing written; 3 a fault of the program, nothing written.");
  refuse_empty_values(*command);
}

}  // namespace

CLI::App* add_remesh_command(CLI::App& app, RemeshArguments& arguments) {
  CLI::App* command = app.add_subcommand("remesh", "Remesh a tetrahedral mesh");
  add_common_flags(command, arguments, "--sol");
  return command;
}

CLI::App* add_implicit_command(CLI::App& app, RemeshArguments& arguments) {
  CLI::App* command =
      app.add_subcommand("implicit", "Cut a tetrahedral mesh along a level set and remesh it");
  add_cut_flags(*command, arguments.implicit.emplace());
  add_common_flags(command, arguments, "--met");
  return command;
}

bool RemeshArguments::detects_ridges() const { return !no_angle && (angle || !is_grid(input)); }

Options to_options(const RemeshArguments& arguments) {
  Options options = arguments.options;
  options.detect_ridges = arguments.detects_ridges();
  if (arguments.angle) options.angle = *arguments.angle;
  if (arguments.no_hgrad) options.hgrad.reset();
  if (arguments.no_hgradreq) options.hgradreq.reset();
  // The library reads 0 as "all cores"; a number that a user typed must be one.
  if (arguments.threads) {
    if (*arguments.threads < 1)
      throw OptionError(fmt::format("--threads must be at least 1, not {}", *arguments.threads));
    options.threads = *arguments.threads;
  }
  if (!arguments.parameters.empty()) {
    Parameters parameters = read_parameters(arguments.parameters);
    options.local = std::move(parameters.local);
    options.size_regions = std::move(parameters.regions);
  }
  validate(options);
  return options;
}

}  // namespace cavea::program
