#pragma once
#include <string>
#include <vector>

#include "cavea/remesh/report.h"

namespace cavea::program {

/// A state of a mesh, as one column of the tables.
struct SummaryColumn {
  std::string title;
  const MeshSummary* summary;
};

/// Counts, quality and angles, one row a figure.
std::string figures_text(const std::vector<SummaryColumn>& columns);

/// The qualities in ten bins: counts and percents.
std::string quality_histogram_text(const std::vector<SummaryColumn>& columns);

/// The lengths in the bins of kLengthBins: counts and percents.
std::string length_histogram_text(const std::vector<SummaryColumn>& columns);

}  // namespace cavea::program
