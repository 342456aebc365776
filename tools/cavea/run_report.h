#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cavea/remesh/report.h"
#include "remesh_arguments.h"
#include "summary_json.h"

namespace cavea::program {

/// What became of one level set.
struct LevelSetRun {
  std::string name;  ///< of its file, and of its grid where one was named
  CutReport cut;
  std::optional<double> distance = {};  ///< of a grid: from the interface, after remeshing
};

/// Everything there is to say about one run of `cavea remesh` or `cavea implicit`.
struct RunReport {
  const RemeshArguments& arguments;
  Report report;
  std::vector<LevelSetRun> level_sets;  ///< of `cavea implicit`, the first one first
  double read_seconds = 0, write_seconds = 0;
};

/// The report as JSON; docs/report.md describes it.
Json to_json(const RunReport& run);

/// The report for people: before and after, time, targets; `verbose` adds phases and verdicts.
std::string to_text(const RunReport& run, bool verbose);

/// A line for each missed target, with its place; empty if all were met.
std::string missed_text(const Report& report);

}  // namespace cavea::program
