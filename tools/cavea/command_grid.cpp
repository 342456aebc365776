#include "command_grid.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "cavea/base/error.h"
#include "empty_values.h"
#include "exit_status.h"
#include "grid_domain.h"
#include "load.h"
#include "output_names.h"
#include "sample_shapes.h"
#include "staging.h"

namespace cavea::program {
namespace {

constexpr const char* kSurface = "surface";

/// The exterior boundary of a mesh: closed, and counter-clockwise from outside.
SurfaceTriangles read_surface(const std::string& file) {
  const TetMesh mesh = load_mesh(file, {}, {}).mesh;
  SurfaceTriangles surface{mesh.points, {}};
  for (const Triangle& s : mesh.triangles)
    if (s.is_exterior()) surface.triangles.push_back(s.v);
  return surface;
}

void write_grid(const GridArguments& arguments, const std::filesystem::path& file) {
  if (arguments.shape != kSurface)
    return write_sample_grid(file, sample_shape(arguments.shape), arguments.settings);
  write_surface_grid(file, read_surface(arguments.surface), arguments.settings);
}

void check_names(const GridArguments& arguments) {
  if ((arguments.shape == kSurface) == arguments.surface.empty())
    throw OptionError(arguments.surface.empty()
                          ? "the shape 'surface' needs FILE, the mesh that it is of"
                          : fmt::format("the shape '{}' is of no FILE", arguments.shape));
  if (!is_grid(arguments.output))
    throw OptionError(fmt::format("-o {}: a grid's name must end in .vdb", arguments.output));
  std::vector<NamedFile> inputs;
  if (!arguments.surface.empty()) inputs.push_back({"the input", arguments.surface});
  check_outputs(inputs, {{"-o", arguments.output}});
}

}  // namespace

CLI::App* add_grid_command(CLI::App& app, GridArguments& arguments) {
  CLI::App* command = app.add_subcommand("grid", "Write a sample level set as an OpenVDB grid");
  std::vector<std::string> shapes = sample_shape_names();
  shapes.emplace_back(kSurface);
  command->add_option("SHAPE", arguments.shape, "What to sample")
      ->required()
      ->check(CLI::IsMember(shapes));
  command->add_option("FILE", arguments.surface, "Mesh whose surface it is, for 'surface'");
  command->add_option("-o,--out", arguments.output, "File to write (.vdb)")->required();
  GridSettings& settings = arguments.settings;
  command->add_option("--voxels", settings.voxels, "Voxels along the longest side")
      ->capture_default_str();
  command
      ->add_option("--half-width", settings.half_width,
                   "Width of the band on either side of the surface, in voxels")
      ->capture_default_str();
  command->add_option("--name", settings.name, "Name of the grid")->capture_default_str();
  refuse_empty_values(*command);
  return command;
}

int run_grid(const GridArguments& arguments) {
  check_names(arguments);
  OutputSet outputs;
  outputs.add(arguments.output,
              [&](const std::filesystem::path& file) { write_grid(arguments, file); });
  for (const auto& file : outputs.publish())
    std::fputs(("written " + file.string() + "\n").c_str(), stdout);
  return kDone;
}

}  // namespace cavea::program
