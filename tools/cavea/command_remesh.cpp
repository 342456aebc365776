#include "command_remesh.h"

#include <cstdio>
#include <functional>
#include <memory>

#include "cavea/base/error.h"
#include "cavea/base/memory.h"
#include "cavea/base/parallel.h"
#include "cavea/base/timer.h"
#include "cavea/field/mesh_size_field.h"
#include "cavea/io/formats.h"
#include "cavea/remesh/remesh.h"
#include "exit_status.h"
#include "interrupt.h"
#include "load.h"
#include "output_names.h"
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
  if (arguments.implicit) inputs.push_back({"the file of --sol", arguments.implicit->values});
  if (!arguments.parameters.empty())
    inputs.push_back({"the file of --params", arguments.parameters});
  if (!arguments.surface.empty()) inputs.push_back({"the file of --surface", arguments.surface});
  check_outputs(inputs, outputs);
}

/// The sizes that were read with the mesh, as the field that the library asks.
SizeField field_of(const RemeshArguments& arguments, const TetMesh& mesh) {
  if (arguments.sizes.empty()) return {};
  return [map = std::make_shared<MeshSizeField>(mesh)](const Vec3& p) { return (*map)(p); };
}

/// Cuts the mesh along the level set of the file. \throw InputError, OptionError
CutReport cut_loaded(const ImplicitArguments& implicit, int threads, LoadedMesh& loaded) {
  const CutOptions options = to_cut_options(implicit);
  if (loaded.repairs.unused_vertices != 0)
    throw InputError("the mesh has vertices of no tet: values cannot be told to be of which");
  const std::vector<double> values = read_values(implicit.values, loaded.mesh.points.size());
  CutResult cut;
  run_in_arena(threads > 0 ? threads : default_threads(),
               [&] { cut = cut_along(loaded.mesh, values, options); });
  loaded.mesh = std::move(cut.mesh);
  return cut.report;
}

/// Runs the library with a progress line, which is gone when this returns.
Report run_library(TetMesh& mesh, const SizeField& field, Options options, bool quiet) {
  if (quiet) return remesh(mesh, field, options);
  ProgressPrinter printer;
  options.progress = [&printer](const Progress& p) { printer.show(p); };
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

RunReport remesh_file(const RemeshArguments& arguments, Options options,
                      const Interrupt& interrupt) {
  Timer timer;
  LoadedMesh loaded = load_mesh(arguments.input, arguments.sizes, arguments.build);
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
  const SizeField field = field_of(arguments, loaded.mesh);
  std::optional<CutReport> cut;
  if (arguments.implicit) cut = cut_loaded(*arguments.implicit, options.threads, loaded);
  RunReport run{arguments, run_library(loaded.mesh, field, options, arguments.quiet), cut,
                read_seconds};
  std::vector<std::string>& warnings = run.report.warnings;
  warnings.insert(warnings.begin(), loaded.warnings.begin(), loaded.warnings.end());

  MeshData data = to_data(loaded.mesh);
  loaded.mesh = {};  // a large mesh should not be held twice while it is written
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

int run_remesh(const RemeshArguments& arguments) {
  const Options options = to_options(arguments);
  check_names(arguments);
  const Interrupt interrupt;
  try {
    const RunReport run = remesh_file(arguments, options, interrupt);
    std::fputs(missed_text(run.report).c_str(), stderr);
    return run.report.targets_met() ? kDone : kMissed;
  } catch (const Cancelled&) {
    std::fputs("cavea: stopped by a signal, nothing was written\n", stderr);
    return kSignalStatus + interrupt.signal();
  }
}

}  // namespace cavea::program
