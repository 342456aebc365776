#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "cavea/remesh/report.h"
#include "remesh_arguments.h"
#include "summary_json.h"

namespace cavea::program {

/// Everything there is to say about one run of `cavea remesh` or `cavea implicit`.
struct RunReport {
  const RemeshArguments& arguments;
  Report report;
  std::optional<CutReport> cut;  ///< of `cavea implicit`
  double read_seconds = 0, write_seconds = 0;
  std::optional<double> interface_distance = {};  ///< from a grid's level set, after remeshing
};

/// The report as JSON; docs/report.md describes it.
Json to_json(const RunReport& run);

/// The report for people: before and after, time, targets; `verbose` adds phases and verdicts.
std::string to_text(const RunReport& run, bool verbose);

/// A line for each missed target, with its place; empty if all were met.
std::string missed_text(const Report& report);

}  // namespace cavea::program
