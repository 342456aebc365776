#include "command_remesh.h"

#include <tbb/global_control.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>

#include "cavea/base/error.h"
#include "cavea/base/memory.h"
#include "cavea/base/parallel.h"
#include "cavea/base/timer.h"
#include "cavea/implicit/project.h"
#include "cavea/io/formats.h"
#include "cavea/remesh/remesh.h"
#include "exit_status.h"
#include "grid_domain.h"
#include "heap.h"
#include "interrupt.h"
#include "load.h"
#include "output_names.h"
#include "prepare.h"
#include "progress.h"
#include "run_report.h"
#include "staging.h"

namespace cavea::program {
namespace {

constexpr int kSignalStatus = 128;  // plus the signal: what shells expect of a stopped program

void check_names(const RemeshArguments& arguments) {
  std::vector<NamedFile> outputs;
  for (const std::string& name : arguments.outputs)
    for (NamedFile& file : files_of_mesh(name)) outputs.push_back(std::move(file));
  if (!arguments.report.empty()) outputs.push_back({"--report", arguments.report});
  std::vector<NamedFile> inputs = {{"the input", arguments.input}};
  if (!arguments.sizes.empty())
    inputs.push_back(
        {arguments.implicit ? "the file of --met" : "the file of --sol", arguments.sizes});
  if (arguments.implicit && !arguments.implicit->values.empty())
    inputs.push_back({"the file of --sol", arguments.implicit->values});
  if (arguments.implicit)
    for (const std::string& file : arguments.implicit->below) inputs.push_back({"an input", file});
  if (!arguments.parameters.empty())
    inputs.push_back({"the file of --params", arguments.parameters});
  if (!arguments.surface.empty()) inputs.push_back({"the file of --surface", arguments.surface});
  check_outputs(inputs, outputs);
}

/// How far the interfaces are from their level sets, where these are known everywhere.
std::vector<LevelSetRun> measure(std::vector<CutLevelSet>& level_sets, const TetMesh& mesh) {
  std::vector<LevelSetRun> runs;
  for (CutLevelSet& cut : level_sets) {
    LevelSetRun& run = runs.emplace_back(std::move(cut.name), cut.report);
    if (cut.meshed)
      run.distance = distance_from(mesh, cut.meshed->level_set, cut.meshed->interface_ref);
  }
  return runs;
}

/// The vertices of interfaces are put onto the level sets that are known everywhere.
std::function<void(TetMesh&)> finish_on(const std::vector<CutLevelSet>& level_sets) {
  std::vector<MeshedLevelSet> meshed;
  for (const CutLevelSet& cut : level_sets)
    if (cut.meshed) meshed.push_back(*cut.meshed);
  if (meshed.empty()) return {};
  return [meshed = std::move(meshed)](TetMesh& mesh) { project_onto(mesh, meshed); };
}

/// Runs the library with a progress line, which is gone when this returns.
Report run_library(TetMesh& mesh, const SizeField& field, Options options, bool quiet, Heap& heap) {
  std::optional<ProgressPrinter> printer;
  if (!quiet) printer.emplace();
  options.progress = [&](const Progress& p) {
    heap.expect(std::max(p.tets, p.wanted));
    if (printer) printer->show(p);
  };
  return remesh(mesh, field, options);
}

/// Writes all files of a run, the report last: it tells what the writing took.
std::vector<std::filesystem::path> write_all(const MeshData& data, RunReport& run,
                                             const Interrupt& interrupt) {
  const Timer timer;
  OutputSet outputs;
  for (const std::string& name : run.arguments.outputs) outputs.add_mesh(name, data);
  run.write_seconds = timer.seconds();
  run.report.peak_resident_bytes = peak_resident_bytes();
  if (!run.arguments.report.empty()) outputs.add_text(run.arguments.report, to_text(to_json(run)));
  if (interrupt.raised()) throw Cancelled();
  return outputs.publish();
}

RunReport remesh_file(const RemeshArguments& arguments, Options options, const Interrupt& interrupt,
                      Heap& heap) {
  Timer timer;
  // What a level set cuts is not only read, and may be large.
  if (arguments.implicit) heap.expect(std::numeric_limits<std::int64_t>::max());
  Prepared prepared = prepare(arguments, options);
  LoadedMesh& loaded = prepared.loaded;
  LoadedMesh surface;
  if (!arguments.surface.empty()) {
    surface = load_mesh(arguments.surface, {}, arguments.build);
    options.surface = &surface.mesh;
    for (const std::string& text : surface.warnings)
      loaded.warnings.push_back(arguments.surface + ": " + text);
  }
  const double read_seconds = timer.seconds();
  options.cancel = interrupt.flag();
  options.directions = true;
  options.finish = finish_on(prepared.level_sets);
  RunReport run{arguments,
                run_library(loaded.mesh, prepared.field, options, arguments.quiet, heap),
                {},
                read_seconds};
  run.level_sets = measure(prepared.level_sets, loaded.mesh);
  std::vector<std::string>& warnings = run.report.warnings;
  warnings.insert(warnings.begin(), loaded.warnings.begin(), loaded.warnings.end());

  // A large mesh should not be held twice while it is written.
  MeshData data = to_data(std::move(loaded.mesh));
  loaded.mesh = {};
  data.parts = std::move(run.report.part_of_tet);
  add_directions(std::move(run.report.directions), data);
  const auto files = write_all(data, run, interrupt);
  if (!arguments.quiet) {
    print_warnings(warnings);
    // stdio, not fmt: a reader of the report that has gone away changes nothing any more.
    std::fputs(to_text(run, arguments.verbose).c_str(), stdout);
    for (const auto& file : files)
      std::fputs(("  written " + file.string() + "\n").c_str(), stdout);
  }
  return run;
}

}  // namespace

int run_remesh(const RemeshArguments& arguments, Heap& heap) {
  if (arguments.implicit) check_level_set(*arguments.implicit, is_grid(arguments.input));
  if (arguments.implicit && is_grid(arguments.input) && !arguments.sizes.empty())
    throw OptionError("--met is for a mesh: a .vdb file has no vertices");
  const Options options = to_options(arguments);
  check_names(arguments);
  const Interrupt interrupt;
  // Reading and writing keep to --threads, too.
  using Control = tbb::global_control;
  const Control threads(Control::max_allowed_parallelism,
                        std::size_t(options.threads > 0 ? options.threads : default_threads()));
  try {
    const RunReport run = remesh_file(arguments, options, interrupt, heap);
    std::fputs(missed_text(run.report).c_str(), stderr);
    return run.report.targets_met() ? kDone : kMissed;
  } catch (const Cancelled&) {
    std::fputs("cavea: stopped by a signal, nothing was written\n", stderr);
    return kSignalStatus + interrupt.signal();
  }
}

}  // namespace cavea::program
