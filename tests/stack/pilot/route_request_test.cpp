#include "stack/pilot/route_request.h"

#include <gtest/gtest.h>

namespace alula::stack::pilot {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;

constexpr double kOpening = 1.4;  // m

Mission ThreeGates() {
  Mission mission;
  for (const double x : {4.0, 8.0, 12.0})
    mission.gates.push_back({"gate", {base::FromYaw(0.0), {x, 0, 1.5}}, kOpening});
  return mission;
}

/// A book that knows each of the first `good` gates well enough to be entered.
GateBook BookWith(int good) {
  GateBook book(ThreeGates(), {}, {});
  for (int i = 0; i < good; ++i) book.TrustList(i);
  return book;
}

TEST(RouteRequest, LeadsThroughTwoGatesAheadAndEndsBeforeOneThatIsNotKnown) {
  const double distance = 2.2;
  const auto two = FindPassages(BookWith(3), {.next_gate = 0}, distance, 0.0);
  ASSERT_EQ(two.passages.size(), 2u);
  EXPECT_FALSE(two.passages[1].closed);
  EXPECT_TRUE(two.passages[1].views_O.empty());
  EXPECT_EQ(two.passages[1].half_opening, 0.5 * kOpening);
  EXPECT_FALSE(two.to_target) << "a third gate is left";

  const auto closed = FindPassages(BookWith(0), {.next_gate = 0}, distance, 0.0);
  ASSERT_EQ(closed.passages.size(), 1u);
  EXPECT_TRUE(closed.passages[0].closed);
  ASSERT_FALSE(closed.passages[0].views_O.empty());
  EXPECT_EQ(closed.passages[0].views_O[0], Vec3(4.0 - distance, 0, 1.5)) << "straight before it";

  EXPECT_TRUE(FindPassages(BookWith(3), {.next_gate = 1}, distance, 0.0).to_target);
  EXPECT_FALSE(FindPassages(BookWith(2), {.next_gate = 2}, distance, 0.0).to_target) << "the last gate is closed";
}

TEST(RouteRequest, TheCorridorBeingLeftComesFirst) {
  const auto ahead = FindPassages(BookWith(3), {.next_gate = 3, .exiting = 2}, 2.2, 0.0);
  ASSERT_EQ(ahead.passages.size(), 1u);
  EXPECT_EQ(ahead.passages[0].gate, 2);
  EXPECT_TRUE(ahead.to_target);
}

TEST(RouteRequest, FollowsTheTrajectoryThatIsFlown) {
  const planning::TrajectoryLimits limits;
  const auto flown =
      planning::Trajectory::Along(Time{}, {}, planning::Curve({Vec3::Zero(), Vec3(6, 0, 0)}), {}, limits);
  ASSERT_TRUE(flown);
  const Time start = Time{} + Milliseconds(1000);
  const auto lead = LeadPoints(*flown, start, limits.knot_period);
  for (std::size_t i = 0; i < lead.size(); ++i) {
    const auto after = base::Seconds(limits.knot_period) + Milliseconds(50) * static_cast<std::int64_t>(i + 1);
    EXPECT_EQ(lead[i], flown->Sample(start + after).p_O);
  }
  const auto zones = FlownZones(*flown, start);
  ASSERT_FALSE(zones.empty());
  EXPECT_EQ(zones.front().a_O, flown->Sample(start).p_O);
  EXPECT_EQ(zones.back().b_O, flown->Sample(flown->end()).p_O);
  for (std::size_t i = 1; i < zones.size(); ++i) EXPECT_EQ(zones[i].a_O, zones[i - 1].b_O) << "no gap";
}

TEST(RouteRequest, ConcedesWhatRecoveryAllows) {
  planning::RouteRequest request;
  request.openings = Openings(BookWith(3));
  ASSERT_EQ(request.openings.size(), 3u);
  Concede({}, request);
  EXPECT_EQ(request.openings.size(), 3u);
  EXPECT_EQ(request.clearance_scale, 1.0);
  Concede({.clearance_scale = 0.7, .known_free_floor = 0.0, .max_speed = 0.6, .ignore_openings = true}, request);
  EXPECT_TRUE(request.openings.empty());
  EXPECT_EQ(request.clearance_scale, 0.7);
  EXPECT_EQ(request.known_free_floor, 0.0);
  EXPECT_EQ(request.max_speed, 0.6);
  EXPECT_TRUE(request.limit_climb);
}

}  // namespace
}  // namespace alula::stack::pilot
