#include "implicit_arguments.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>

#include "cavea/base/error.h"

namespace cavea::program {
namespace {

[[noreturn]] void refuse(const std::string& entry, const char* why) {
  throw OptionError(fmt::format("--reference-map {}: {}", entry, why));
}

/// Takes one number off the front of `text`, with the colon behind it if there is one.
std::int32_t take_reference(std::string_view& text, const std::string& entry) {
  std::int32_t ref = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ref);
  if (error != std::errc{}) refuse(entry, "is not REF:IN:OUT or REF:keep");
  text.remove_prefix(std::size_t(end - text.data()));
  if (text.starts_with(':')) text.remove_prefix(1);
  return ref;
}

void add_entry(const std::string& entry, CutOptions& options) {
  std::string_view rest = entry;
  const std::int32_t ref = take_reference(rest, entry);
  CutMaterial material;
  material.split = rest != "keep";
  if (material.split) {
    material.inside = take_reference(rest, entry);
    material.outside = take_reference(rest, entry);
    if (!rest.empty()) refuse(entry, "is not REF:IN:OUT or REF:keep");
    if (material.inside == material.outside) refuse(entry, "both sides have one reference");
  }
  if (!options.material_of_ref.emplace(ref, material).second)
    refuse(entry, "the reference has an entry already");
}

}  // namespace

void one_value_each(CLI::Option* option) {
  option->expected(1)->take_all()->allow_extra_args(false);
}

void add_cut_flags(CLI::App& command, ImplicitArguments& arguments) {
  CutOptions& cut = arguments.cut;
  command.add_option("--sol", arguments.values,
                     "The level set's values at the vertices of IN (.sol, .solb)");
  one_value_each(command.add_option(
      "--grid", arguments.grids,
      "Which grid of IN (.vdb), if there are several; may be given again, as may files: what is "
      "inside of an earlier one is not of a later one"));
  command
      .add_option("--box", arguments.box,
                  "XMIN,YMIN,ZMIN,XMAX,YMAX,ZMAX: what to mesh of IN (.vdb) [around the level set]")
      ->expected(6)
      ->delimiter(',');
  command.add_option("--iso", arguments.isovalue,
                     "The inside is where values are smaller; in a fog volume, larger "
                     "[0; of a fog volume 0.5]");
  command.add_option("--keep", arguments.keep, "What to write of the cut mesh")
      ->check(CLI::IsMember({"both", "inside", "outside"}))
      ->capture_default_str();
  command.add_option("--remove-components", cut.remove_components,
                     "Drop components, and fill cavities, below this share of the volume");
  command.add_option("--inside-ref", cut.material.inside, "Reference of tets inside")
      ->capture_default_str();
  command.add_option("--outside-ref", cut.material.outside, "Reference of tets outside")
      ->capture_default_str();
  command.add_option("--interface-ref", cut.interface_ref, "Reference of triangles between")
      ->capture_default_str();
  one_value_each(
      command.add_option("--reference-map", arguments.reference_map,
                         "REF:IN:OUT or REF:keep, for tets of one reference; may be given again"));
}

void add_stack_positional(CLI::App& command, ImplicitArguments& arguments) {
  command.add_option("BELOW", arguments.below, "More files of grids (.vdb), of lower priority");
}

void check_level_set(const ImplicitArguments& arguments, bool is_grid) {
  if (is_grid && !arguments.values.empty())
    throw OptionError("--sol is for a mesh, not for a .vdb file, which has values of its own");
  if (!is_grid && arguments.values.empty())
    throw OptionError("--sol is needed: the level set's values at the vertices of the mesh");
  if (!is_grid && !arguments.grids.empty()) throw OptionError("--grid is for a .vdb file");
  if (!is_grid && !arguments.below.empty())
    throw OptionError(fmt::format("{}: only .vdb files can be stacked", arguments.below[0]));
  if (!is_grid && !arguments.box.empty()) throw OptionError("--box is for a .vdb file");
}

CutOptions to_cut_options(const ImplicitArguments& arguments) {
  CutOptions options = arguments.cut;
  options.isovalue = arguments.isovalue.value_or(0);
  if (options.material.inside == options.material.outside)
    throw OptionError("--inside-ref and --outside-ref must differ");
  options.keep = arguments.keep == "inside"    ? CutKeep::kInside
                 : arguments.keep == "outside" ? CutKeep::kOutside
                                               : CutKeep::kBoth;
  for (const std::string& entry : arguments.reference_map) add_entry(entry, options);
  return options;
}

}  // namespace cavea::program
