#include "base/time.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace alula::base {
namespace {

TEST(Time, SumsAreExact) {
  Time t;
  for (int i = 0; i < 36'000; ++i) t += Milliseconds(1);
  EXPECT_EQ(t, Time{36'000'000'000});
  EXPECT_EQ(t - Time{1'000'000'000}, Milliseconds(35'000));
  EXPECT_LT(t, t + Nanoseconds(1));
}

TEST(Time, SecondsRoundToTheNearestNanosecond) {
  EXPECT_EQ(Seconds(0.1).ns, 100'000'000);
  EXPECT_EQ(Seconds(-0.1).ns, -100'000'000);
  EXPECT_EQ(Seconds(1.0 / 3.0).ns, 333'333'333);
}

TEST(Rate, SamplesNeverDrift) {
  const Rate thirty{30, 1};
  EXPECT_EQ(thirty.SampleTime(1).ns, 33'333'333);
  EXPECT_EQ(thirty.SampleTime(2).ns, 66'666'666);
  EXPECT_EQ(thirty.SampleTime(30).ns, 1'000'000'000);
  EXPECT_EQ(thirty.SampleTime(30LL * 36'000).ns, 36'000'000'000'000);
  const Rate ntsc{30000, 1001};
  EXPECT_EQ(ntsc.SampleTime(30000).ns, 1'001'000'000'000);
}

TEST(Rate, SampleTimeIsTheFloorOfTheExactFraction) {
  RandomStream random(1, "rates");
  for (int i = 0; i < 1000; ++i) {
    const Rate rate{1 + static_cast<std::int64_t>(random.Index(100'000)),
                    1 + static_cast<std::int64_t>(random.Index(5'000))};
    const auto n = static_cast<std::int64_t>(random.Index(10'000'000));
    __extension__ using Wide = __int128;
    const Wide exact = static_cast<Wide>(n) * rate.seconds * 1'000'000'000 / rate.cycles;
    ASSERT_EQ(rate.SampleTime(n).ns, static_cast<std::int64_t>(exact)) << rate.cycles << "/" << rate.seconds;
  }
}

}  // namespace
}  // namespace alula::base
