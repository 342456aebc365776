#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "cavea/remesh/report.h"

namespace cavea::program {

/// Keeps the order in which keys were added: a report is also read by people.
using Json = nlohmann::ordered_json;

/// Counts, quality, dihedral angles and lengths of a mesh; docs/report.md lists the keys.
Json to_json(const MeshSummary& summary);

/// The text of a file; bytes of file names that are no UTF-8 are replaced.
std::string to_text(const Json& json);

}  // namespace cavea::program
