#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <functional>
#include <new>

#include "cavea/base/error.h"
#include "command_grid.h"
#include "command_info.h"
#include "command_remesh.h"
#include "exit_status.h"
#include "heap.h"

namespace {

using namespace cavea;
using namespace cavea::program;

int fail(ExitStatus status, const char* what) {
  fmt::print(stderr, "cavea: error: {}\n", what);
  return status;
}

/// Runs a command and turns what it throws into a message and a status.
int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const InputError& e) {
    return fail(kBadInput, e.what());
  } catch (const OptionError& e) {
    return fail(kBadInput, e.what());
  } catch (const MemoryError& e) {
    return fail(kBadInput, e.what());
  } catch (const std::bad_alloc&) {
    return fail(kOurFault, "out of memory");
  } catch (const std::exception& e) {
    return fail(kOurFault, e.what());
  }
}

int run(int argc, char** argv, Heap& heap) {
  CLI::App app{"Parallel tetrahedral remeshing.", "cavea"};
  app.set_version_flag("--version", "cavea " CAVEA_VERSION);
  app.require_subcommand(1);
  RemeshArguments remesh_arguments, implicit_arguments;
  InfoArguments info_arguments;
  GridArguments grid_arguments;
  CLI::App* remesh = add_remesh_command(app, remesh_arguments);
  CLI::App* implicit = add_implicit_command(app, implicit_arguments);
  CLI::App* grid = add_grid_command(app, grid_arguments);
  add_info_command(app, info_arguments);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return app.exit(e);  // prints the help or the version
  } catch (const CLI::ParseError& e) {
    return fail(kBadInput, fmt::format("{} (--help tells more)", e.what()).c_str());
  }
  if (implicit->parsed()) return run_remesh(implicit_arguments, heap);
  if (grid->parsed()) return run_grid(grid_arguments);
  return remesh->parsed() ? run_remesh(remesh_arguments, heap) : run_info(info_arguments);
}

}  // namespace

int main(int argc, char** argv) {
  Heap heap;
  return guarded([&] { return run(argc, argv, heap); });
}
