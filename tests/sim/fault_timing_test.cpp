#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/faults/timing.h"

namespace alula::sim::faults {
namespace {

using base::Milliseconds;
using base::Time;

/// The steps (of 1 ms, from 0) in which a fault lasts.
std::vector<int> Lasting(const Timing& timing, int steps, const std::function<void(int, Situation&)>& situate = {},
                         std::uint64_t seed = 1) {
  Onset onset(timing, seed, "test");
  std::vector<int> lasting;
  for (int i = 0; i < steps; ++i) {
    Situation situation{.now = Time{std::int64_t{i} * 1'000'000}};
    if (situate) situate(i, situation);
    if (onset.Lasts(situation)) lasting.push_back(i);
  }
  return lasting;
}

std::vector<int> Range(int first, int end) {
  std::vector<int> range;
  for (int i = first; i < end; ++i) range.push_back(i);
  return range;
}

TEST(FaultTiming, AtATimeForADurationOrForEver) {
  EXPECT_EQ(Lasting({.at = Milliseconds(3), .duration = Milliseconds(4)}, 20), Range(3, 7));
  EXPECT_EQ(Lasting({.at = Milliseconds(3)}, 20), Range(3, 20));
  EXPECT_EQ(Lasting({.at = Milliseconds(0), .duration = Milliseconds(1)}, 20), Range(0, 1));
  // Between steps: the next one begins it, its end counts from when it should have begun.
  EXPECT_EQ(Lasting({.at = base::Microseconds(2500), .duration = Milliseconds(2)}, 20), Range(3, 5));
}

TEST(FaultTiming, RepeatsFromBeginToBegin) {
  Timing timing{.at = Milliseconds(2), .duration = Milliseconds(1), .every = Milliseconds(5)};
  EXPECT_EQ(Lasting(timing, 15), (std::vector<int>{2, 7, 12}));
  timing.times = 2;
  EXPECT_EQ(Lasting(timing, 15), (std::vector<int>{2, 7}));
  timing.every = timing.duration;  // back to back
  timing.times.reset();
  EXPECT_EQ(Lasting(timing, 8), Range(2, 8));
}

TEST(FaultTiming, BeginsWhenAConditionComesToHold) {
  const auto climb = [](int i, Situation& s) { s.height = i < 10 ? 0.1 * i : 0.1 * (20 - i); };  // up to 1 m and down
  Timing timing{.when = Condition{.height_above = 0.45}, .duration = Milliseconds(3)};
  EXPECT_EQ(Lasting(timing, 20, climb), Range(5, 8));  // once, though it still holds after the end
  const auto twice = [&](int i, Situation& s) { climb(i % 20, s); };
  EXPECT_EQ(Lasting(timing, 40, twice), Range(5, 8));
  timing.times = 2;
  EXPECT_EQ(Lasting(timing, 40, twice), (std::vector<int>{5, 6, 7, 25, 26, 27}));
  EXPECT_EQ(Lasting({.when = Condition{.height_above = 0.45}}, 20, climb), Range(5, 20));
}

TEST(FaultTiming, AConditionIsAllThatItStates) {
  using Mode = stack::VehicleStatus::Mode;
  const Situation s{.height = 2.0, .speed = 1.5, .target_distance = 8.0, .gates_passed = 3, .mode = Mode::kFollowing};
  EXPECT_TRUE(Holds({.height_above = 1.9, .height_below = 2.1}, s));
  EXPECT_FALSE(Holds({.height_above = 2.0}, s));
  EXPECT_TRUE(Holds({.speed_above = 1.4, .speed_below = 1.6}, s));
  EXPECT_FALSE(Holds({.speed_below = 1.5}, s));
  EXPECT_TRUE(Holds({.target_within = 8.1}, s));
  EXPECT_FALSE(Holds({.target_within = 7.9}, s));
  EXPECT_TRUE(Holds({.gates_passed = 3}, s));
  EXPECT_FALSE(Holds({.gates_passed = 4}, s));
  EXPECT_TRUE(Holds({.mode = Mode::kFollowing}, s));
  EXPECT_FALSE(Holds({.height_above = 1.0, .mode = Mode::kLanding}, s));
}

TEST(FaultTiming, RandomOnsetsAreAPoissonProcess) {
  const Timing timing{.rate = 50.0, .duration = Milliseconds(2)};
  const std::vector<int> lasting = Lasting(timing, 400'000);
  std::vector<double> gaps;  // from an end to the next begin, ms
  for (std::size_t i = 1; i < lasting.size(); ++i) {
    if (lasting[i] != lasting[i - 1] + 1) gaps.push_back(lasting[i] - lasting[i - 1] - 1);
  }
  double mean = 0.0, square = 0.0;
  for (const double gap : gaps) mean += gap / static_cast<double>(gaps.size());
  for (const double gap : gaps) square += (gap - mean) * (gap - mean) / static_cast<double>(gaps.size());
  // Exponential with mean 20 ms, rounded up to steps; those of no gap at all were not counted: 5 %.
  EXPECT_NEAR(mean, 21.0, 4 * 20.0 / std::sqrt(static_cast<double>(gaps.size())));
  EXPECT_NEAR(std::sqrt(square), 20.0, 1.5);
  EXPECT_EQ(Lasting(timing, 5000), Lasting(timing, 5000));
  EXPECT_NE(Lasting(timing, 5000), Lasting(timing, 5000, {}, 2));
  EXPECT_EQ(Lasting({.rate = 50.0, .times = 1}, 5000).size(), 5000U - static_cast<std::size_t>(lasting[0]));
}

}  // namespace
}  // namespace alula::sim::faults
