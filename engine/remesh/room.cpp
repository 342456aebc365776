#include "cavea/remesh/room.h"

#include "cavea/remesh/standing.h"

namespace cavea {

bool has_room(const MeshSummary& after, const Options& options) {
  constexpr double kRoomyConform = 90;  // the usual target
  constexpr double kConformLost = 80;   // percent, where all of the mean is lost: 8 for hgrad 3
  const double lost = mean_lost_to_gradation(options);
  return after.quality.mean >= kRoomyMean - lost &&
         after.lengths.conforming_percent() >= kRoomyConform - kConformLost * lost;
}

bool hardly_has_room(const MeshSummary& after, const Options& options) {
  constexpr double kChance = 0.01;  // most runs from different meshes differ by less
  return after.quality.mean < kRoomyMean - mean_lost_to_gradation(options) + kChance;
}

bool is_coarse_mesh(const MeshSummary& after) {
  constexpr std::int64_t kCoarseMesh = 150000;
  return after.counts.tets < kCoarseMesh;
}

Room room_in(const MeshSummary& after, const Options& options, bool has_field) {
  constexpr double kSurelyRoomyMean = 0.82;    // no other run has less than a mean with room
  constexpr std::int64_t kLargeMesh = 500000;  // which should not take thrice the time unasked
  if (sizes_are_given(options, has_field) || after.counts.tets >= kLargeMesh) return Room::kEnough;
  if (!has_room(after, options)) return Room::kMissing;
  const double surely = kSurelyRoomyMean - mean_lost_to_gradation(options);
  return is_coarse_mesh(after) && after.quality.mean < surely ? Room::kLittle : Room::kEnough;
}

}  // namespace cavea
