#include "cavea/field/spots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/expect.h"
#include "support/meshes.h"

namespace cavea::test {
namespace {

TEST(Spots, AskForTheSmallestSizeOfThoseAroundAPlace) {
  constexpr std::uint64_t kSeed = 3;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Random random(kSeed);
  const auto place = [&] {
    return Vec3{random.between(0, 1), random.between(0, 1), random.between(0, 1)};
  };
  for (const int count : {0, 1, 7, 300}) {
    std::vector<SizeSphere> spots;
    for (int k = 0; k < count; ++k)
      spots.push_back({place(), random.between(0, 0.3), random.between(0.01, 0.1)});
    const SizeField field = field_inside(spots);
    for (int k = 0; k < 500; ++k) {
      const Vec3 p = place();
      double expected = kInfinity;
      for (const SizeSphere& s : spots)
        if (distance(s.center, p) < s.radius) expected = std::min(expected, s.size);
      EXPECT_EQ(field(p), expected) << count << " spots, seed " << kSeed;
    }
  }
}

}  // namespace
}  // namespace cavea::test
