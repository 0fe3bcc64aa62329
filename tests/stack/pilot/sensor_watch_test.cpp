#include "stack/pilot/sensor_watch.h"

#include <gtest/gtest.h>

namespace alula::stack::pilot {
namespace {

using base::Time;

Time At(std::int64_t ms) { return Time{ms * 1'000'000}; }

ImuSample Reading(double x) { return {{x, 0, 0}, {0, 0, 9.8}}; }

Image Picture(std::uint8_t value) {
  Image image;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(16, value);
  return image;
}

TEST(SensorWatch, TrustsWhatIsFedAndNothingElse) {
  SensorWatch watch{SensorWatchConfig{}};
  EXPECT_FALSE(watch.Trusted(At(0)));
  EXPECT_TRUE(watch.Accept(At(10), Reading(0.1), true));
  EXPECT_FALSE(watch.Trusted(At(10)));
  watch.NoteFrame(At(10));
  EXPECT_TRUE(watch.Trusted(At(110)));
  EXPECT_FALSE(watch.Trusted(At(111)));  // no IMU for more than 100 ms
  for (int i = 1; i <= 110; ++i) watch.Accept(At(10 + 10 * i), Reading(0.1 * i), true);
  EXPECT_TRUE(watch.Trusted(At(1010)));
  EXPECT_FALSE(watch.Trusted(At(1011)));  // no frame for more than a second
  watch.NoteFrame(At(1050));
  EXPECT_TRUE(watch.Trusted(At(1111)));
  watch.Accept(At(500), Reading(7), true);  // an old sample that was delayed makes nothing younger
  EXPECT_FALSE(watch.Trusted(At(1250)));
}

TEST(SensorWatch, AnImuThatRepeatsItselfInFlightIsSilent) {
  SensorWatch watch{SensorWatchConfig{}};
  watch.NoteFrame(At(0));
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(watch.Accept(At(5 * i), Reading(0.1), false));  // on the ground it may
  for (int i = 0; i < 9; ++i) EXPECT_TRUE(watch.Accept(At(250 + 5 * i), Reading(0.1), true));
  EXPECT_FALSE(watch.Accept(At(295), Reading(0.1), true));  // the tenth in a row
  EXPECT_TRUE(watch.Trusted(At(390)));
  EXPECT_FALSE(watch.Accept(At(390), Reading(0.1), true));
  EXPECT_FALSE(watch.Trusted(At(391)));
  EXPECT_TRUE(watch.Accept(At(400), Reading(0.2), true));
  EXPECT_TRUE(watch.Trusted(At(401)));
}

TEST(SensorWatch, ACameraThatRepeatsItselfInFlightIsSilent) {
  SensorWatch watch{SensorWatchConfig{}};
  const SensorId left{10}, right{11};
  EXPECT_TRUE(watch.Accept(left, Picture(1), true));
  EXPECT_TRUE(watch.Accept(right, Picture(1), true));  // each camera by itself
  EXPECT_FALSE(watch.Accept(left, Picture(1), true));
  EXPECT_TRUE(watch.Accept(left, Picture(2), true));
  EXPECT_TRUE(watch.Accept(left, Picture(2), false));
}

}  // namespace
}  // namespace alula::stack::pilot
