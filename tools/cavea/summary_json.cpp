#include "summary_json.h"

namespace cavea::program {
namespace {

Json to_json(const Vec3& p) { return Json::array({p.x, p.y, p.z}); }

Json to_json(const Counts& counts) {
  Json tet_refs = Json::array(), triangle_refs = Json::array();
  for (const auto& [ref, tets] : counts.tets_of_ref) {
    const auto volume = counts.volume_of_ref.find(ref);
    tet_refs.push_back({{"reference", ref},
                        {"tets", tets},
                        {"volume", volume == counts.volume_of_ref.end() ? 0 : volume->second}});
  }
  for (const auto& [ref, triangles] : counts.triangles_of_ref)
    triangle_refs.push_back({{"reference", ref}, {"triangles", triangles}});
  return {{"vertices", counts.vertices},
          {"tets", counts.tets},
          {"triangles", counts.triangles},
          {"ridges", counts.ridges},
          {"corners", counts.corners},
          {"required_vertices", counts.required_vertices},
          {"components", counts.components},
          {"boundary_components", counts.boundary_components},
          {"volume", counts.volume},
          {"box_min", to_json(counts.box_min)},
          {"box_max", to_json(counts.box_max)},
          {"tet_references", tet_refs},
          {"triangle_references", triangle_refs}};
}

/// Tets are named as in a file, from one.
Json to_json(const std::vector<FlatTet>& flat) {
  Json tets = Json::array();
  for (const FlatTet& f : flat) tets.push_back({{"tet", f.tet + 1}, {"place", to_json(f.place)}});
  return tets;
}

Json to_json(const QualityStatistics& quality) {
  return {{"worst", quality.worst},
          {"mean", quality.mean},
          {"worst_place", to_json(quality.worst_place)},
          {"flat_tets", to_json(quality.flat)},
          {"histogram", quality.histogram}};
}

Json dihedral_json(const QualityStatistics& quality) {
  return {{"smallest", quality.smallest_dihedral},
          {"largest", quality.largest_dihedral},
          {"histogram", quality.dihedral_histogram}};
}

Json to_json(const LengthStatistics& lengths) {
  if (!lengths.edges) return nullptr;
  return {{"edges", lengths.edges},
          {"shortest", lengths.shortest},
          {"mean", lengths.mean},
          {"longest", lengths.longest},
          {"conforming", lengths.conforming},
          {"conforming_percent", lengths.conforming_percent()},
          {"bins", kLengthBins},
          {"histogram", lengths.histogram}};
}

}  // namespace

Json to_json(const MeshSummary& summary) {
  return {{"counts", to_json(summary.counts)},
          {"quality", to_json(summary.quality)},
          {"dihedral", dihedral_json(summary.quality)},
          {"lengths", to_json(summary.lengths)}};
}

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace cavea::program
