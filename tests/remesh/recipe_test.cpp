// What the phases ask.
#include "cavea/remesh/recipe.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cavea/remesh/standing.h"

namespace cavea::test {
namespace {

double offers_below(const Phase& p) {
  return std::max(p.cycle.repair_below, p.cycle.reconnect_below);
}

// A tet that was asked is not asked again until something changes around it.
TEST(Recipe, WhatAPhaseOffersFirstItAsksAgain) {
  for (const Seeds seeds :
       {Seeds::kAbsent, Seeds::kSome, Seeds::kMost, Seeds::kNearlyAll, Seeds::kEven}) {
    const std::vector<Phase> phases = recipe({}, seeds);
    const Phase& last = phases.back();
    EXPECT_GE(last.ask_below, offers_below(last));
  }
}

TEST(Recipe, PoorTetsAreAskedByEachPhaseThatMendsThem) {
  const std::vector<Phase> phases = asking_poor(poor_recipe({}));
  for (std::size_t i = 1; i < phases.size(); ++i) EXPECT_GE(phases[i].ask_below, kPoorQuality);
}

TEST(Recipe, WhatStandsIsAskedOnlyWhereItIsPoor) {
  for (const Phase& phase : standing_recipe({})) EXPECT_EQ(phase.ask_below, 0);
}

TEST(Recipe, WhatStandsIsMovedOnlyWhereItIsNotGood) {
  for (const auto& phases : {standing_recipe({}), holding_good(poor_recipe({}))})
    for (const Phase& phase : phases) {
      EXPECT_GE(phase.cycle.move_ceiling, kPoorQuality);
      EXPECT_LT(phase.cycle.move_ceiling, last_phase({}).cycle.move_ceiling);
    }
}

}  // namespace
}  // namespace cavea::test
