#include "base/units.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/internal/quantity.h"
#include "base/nearest.h"

namespace alula::base {
namespace {

double Si(double number, std::string_view unit) {
  const std::optional<Unit> parsed = ParseUnit(unit);
  EXPECT_TRUE(parsed) << unit;
  return parsed ? parsed->ToSi(number) : NAN;
}

TEST(Units, DecimalScalesAreExactToTheBit) {
  EXPECT_EQ(Si(250, "mm"), 0.25);
  EXPECT_EQ(Si(3, "mm"), 0.003);
  EXPECT_EQ(Si(750, "g"), 0.75);
  EXPECT_EQ(Si(12, "%"), 0.12);
  EXPECT_EQ(Si(5, "inch"), 0.127);
  EXPECT_EQ(Si(36, "km/h"), 10.0);
  EXPECT_EQ(Si(1500, "mAh"), 5400.0);
  EXPECT_EQ(Si(1, "g0"), 9.80665);
  EXPECT_EQ(Si(70, "deg"), 70 * M_PI / 180);
  EXPECT_DOUBLE_EQ(Si(2300, "rpm/V"), 2300 * 2 * M_PI / 60);
}

TEST(Units, FormsOfOneUnitAgree) {
  const auto same = [](std::string_view a, std::string_view b) {
    const auto x = ParseUnit(a), y = ParseUnit(b);
    return x && y && x->SameDimension(*y) && std::abs(x->ToSi(1) - y->ToSi(1)) < 1e-15 * std::abs(y->ToSi(1));
  };
  EXPECT_TRUE(same("m/s^2", "m/s²"));
  EXPECT_TRUE(same("m/s2", "m s^-2"));
  EXPECT_TRUE(same("rad/s/sqrt(Hz)", "rad/√s"));
  EXPECT_TRUE(same("rad/s/√Hz", "rad/s/Hz^0.5"));
  EXPECT_TRUE(same("N", "kg·m/s²"));
  EXPECT_TRUE(same("N m", "N*m"));
  EXPECT_TRUE(same("kg m^2", "kg (m^2)"));
  EXPECT_TRUE(same("µs", "us"));
  EXPECT_TRUE(same("1", ""));
  EXPECT_TRUE(same("km/km", "1"));
  EXPECT_FALSE(same("rad/s", "Hz"));  // angles count as a dimension
}

TEST(Units, WhatIsNoUnitIsRefused) {
  for (const char* text : {"metre", "m//s", "/s", "m/", "m^", "m^0.3", "(m", "m)", "m^99", "sqrt(m", "kkg",
                           "((((((((((m))))))))))", "m^m", "1e3", "\xff", "m*", "·"}) {
    EXPECT_FALSE(ParseUnit(text)) << text;
  }
}

TEST(Quantity, RatesAreExact) {
  EXPECT_EQ(quantity::ParseRate("30 Hz"), (Rate{30, 1}));
  EXPECT_EQ(quantity::ParseRate("1/3 Hz"), (Rate{1, 3}));
  EXPECT_EQ(quantity::ParseRate("29.97 Hz"), (Rate{2997, 100}));
  EXPECT_EQ(quantity::ParseRate("30000/1001 Hz"), (Rate{30000, 1001}));
  EXPECT_EQ(quantity::ParseRate("1 kHz"), (Rate{1000, 1}));
  EXPECT_EQ(quantity::ParseRate("60/2 Hz"), (Rate{30, 1}));
  EXPECT_EQ(quantity::Format(Rate{60, 2}), "30 Hz");
  EXPECT_EQ(quantity::Format(Rate{1, 3}), "1/3 Hz");
}

TEST(Quantity, DurationsAreExact) {
  EXPECT_EQ(quantity::ParseDuration("8 ms").ns, 8'000'000);
  EXPECT_EQ(quantity::ParseDuration("2 h").ns, 7'200'000'000'000);
  EXPECT_EQ(quantity::ParseDuration("0.1 s").ns, 100'000'000);
  EXPECT_EQ(quantity::ParseDuration("-3 us").ns, -3'000);
  for (const std::int64_t ns : {0LL, 1LL, 999LL, 1'000LL, 1'234'567LL, 8'000'000LL, 86'399'999'999'999LL, -5LL}) {
    EXPECT_EQ(quantity::ParseDuration(quantity::Format(Nanoseconds(ns))).ns, ns);
  }
}

TEST(Nearest, FindsTheWordThatWasMeant) {
  const std::vector<std::string> words = {"mass", "radius", "drag_coefficient", "gates"};
  EXPECT_EQ(NearestWord("masss", words), "mass");
  EXPECT_EQ(NearestWord("amss", words), "mass");
  EXPECT_EQ(NearestWord("drag_coeficient", words), "drag_coefficient");
  EXPECT_EQ(NearestWord("drag", words), "drag_coefficient");
  EXPECT_EQ(NearestWord("xyz", words), "");
  EXPECT_EQ(EditDistance("kitten", "sitting"), 3u);
  EXPECT_EQ(EditDistance("ab", "ba"), 1u);
  EXPECT_EQ(EditDistance("", "abc"), 3u);
}

}  // namespace
}  // namespace alula::base
