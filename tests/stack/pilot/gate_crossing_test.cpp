#include "stack/pilot/gate_crossing.h"

#include <gtest/gtest.h>

namespace alula::stack::pilot {
namespace {

using base::Vec3;

constexpr double kOpening = 1.4;  // m

TEST(GateCrossing, CountsOnlyForwardStepsThroughThePlane) {
  EXPECT_EQ(CrossingOf({-0.1, 0, 0}, {0.1, 0, 0}, kOpening), Crossing::kThrough);
  EXPECT_EQ(CrossingOf({-0.1, 0, 0}, {0.0, 0, 0}, kOpening), Crossing::kThrough) << "the plane belongs to behind";
  EXPECT_EQ(CrossingOf({0.0, 0, 0}, {0.1, 0, 0}, kOpening), Crossing::kNone) << "so that no crossing counts twice";
  EXPECT_EQ(CrossingOf({0.1, 0, 0}, {-0.1, 0, 0}, kOpening), Crossing::kNone) << "backwards";
  EXPECT_EQ(CrossingOf({-0.2, 0, 0}, {-0.1, 0, 0}, kOpening), Crossing::kNone);
}

TEST(GateCrossing, TheOpeningIsASquare) {
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(CrossingOf({-0.1, 0, 0}, {0.1, 0.69 * sign, 0.69 * sign}, kOpening), Crossing::kThrough);
    EXPECT_EQ(CrossingOf({-0.1, 0, 0}, {0.1, 0.71 * sign, 0}, kOpening), Crossing::kBeside);
    EXPECT_EQ(CrossingOf({-0.1, 0, 0}, {0.1, 0, 0.71 * sign}, kOpening), Crossing::kBeside);
    EXPECT_EQ(CrossingOf({-0.1, 0, 0}, {0.1, 2.01 * sign, 0}, kOpening), Crossing::kNone) << "somewhere else";
  }
}

TEST(GateCrossing, TheFrameLeavesTheViewJustBeforeTheOpening) {
  EXPECT_FALSE(FrameLeavesView({-1.2, 0, 0}, 1.1));
  EXPECT_TRUE(FrameLeavesView({-1.0, 0, 0}, 1.1));
  EXPECT_FALSE(FrameLeavesView({-1.0, 1.1, 0}, 1.1)) << "seen from the side";
  EXPECT_FALSE(FrameLeavesView({0.6, 0, 0}, 1.1)) << "behind it";
}

TEST(GateCrossing, TheCorridorEndsAfterTheStraightFlightOrFarAway) {
  EXPECT_FALSE(CorridorLeft({0.5, 0, 0}, 1.2));
  EXPECT_FALSE(CorridorLeft({1.04, 0, 0}, 1.2));
  EXPECT_TRUE(CorridorLeft({1.06, 0, 0}, 1.2));
  EXPECT_TRUE(CorridorLeft({-3.1, 0, 0}, 1.2));
}

}  // namespace
}  // namespace alula::stack::pilot
