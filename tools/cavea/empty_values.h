#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace cavea::program {

/// CLI11 takes an empty word for a number as "not given", and an empty file name would mean "none":
/// a script whose variable is unset must be told instead. Call it after all options were added.
inline void refuse_empty_values(CLI::App& command) {
  const CLI::Validator not_empty(
      [](std::string& value) { return value.empty() ? std::string("is empty") : std::string(); },
      "");
  for (CLI::Option* option : command.get_options())
    if (option->get_items_expected_max() > 0) option->check(not_empty);
}

}  // namespace cavea::program
