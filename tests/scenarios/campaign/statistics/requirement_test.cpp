#include "scenarios/campaign/statistics/requirement.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"

namespace alula::scenarios::statistics {
namespace {

TEST(Requirement, ReadsSuccess) {
  for (const char* text :
       {"success >= 0.95 @ 95%", "success>=0.95@95%", " success >= 0.95 @ 0.95 ", "success >= 95% @ 95 %"}) {
    const Requirement requirement = ParseRequirement(text);
    EXPECT_FALSE(requirement.metric) << text;
    EXPECT_DOUBLE_EQ(requirement.rate.at_least, 0.95) << text;
    EXPECT_DOUBLE_EQ(requirement.rate.confidence, 0.95) << text;
    EXPECT_EQ(requirement.text, text);
  }
}

TEST(Requirement, ReadsMetrics) {
  const Requirement most = ParseRequirement("P(ate_online_m <= 0.5) >= 0.9 @ 99%");
  ASSERT_TRUE(most.metric);
  EXPECT_EQ(most.metric->name, "ate_online_m");
  EXPECT_TRUE(most.metric->at_most);
  EXPECT_EQ(most.metric->limit, 0.5);
  EXPECT_DOUBLE_EQ(most.rate.confidence, 0.99);
  EXPECT_TRUE(most.metric->Holds(0.5));
  EXPECT_FALSE(most.metric->Holds(0.51));
  EXPECT_FALSE(most.metric->Holds(std::nan("")));

  const Requirement least = ParseRequirement("P( min_clearance_m>=-1.5e-1 )>=0.9@0.9");
  ASSERT_TRUE(least.metric);
  EXPECT_FALSE(least.metric->at_most);
  EXPECT_EQ(least.metric->limit, -0.15);
  EXPECT_FALSE(least.metric->Holds(std::nan("")));
}

std::string MessageOf(const char* text) {
  try {
    ParseRequirement(text);
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "read";
}

TEST(Requirement, SaysWhichPartIsWrong) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "expected 'success' or 'P('"},
      {"ate >= 0.95 @ 95%", "unknown subject 'ate'"},
      {"success <= 0.95 @ 95%", "expected '>=' before the rate"},
      {"success >= lots @ 95%", "the rate must be a number"},
      {"success >= 1 @ 95%", "the rate must lie between 0 and 1"},
      {"success >= 0 @ 95%", "the rate must lie between 0 and 1"},
      {"success >= nan @ 95%", "the rate must be a number"},
      {"success >= 0.95", "expected '@' before the confidence, found the end"},
      {"success >= 0.95 @ 49%", "at least 50%"},
      {"success >= 0.95 @ 100%", "below 100%"},
      {"success >= 0.95 @ 95", "below 100%"},
      {"success >= 0.95 @ 95% please", "nothing may follow"},
      {"P(<= 0.5) >= 0.9 @ 95%", "expected the name of a metric"},
      {"P(ate < 0.5) >= 0.9 @ 95%", "after the metric's name"},
      {"P(ate <= ) >= 0.9 @ 95%", "the limit of ate must be a number"},
      {"P(ate <= inf) >= 0.9 @ 95%", "the limit of ate must be a number"},
      {"P(ate <= 0.5 m) >= 0.9 @ 95%", "expected ')'"},
      {"P ate <= 0.5 >= 0.9 @ 95%", "expected '('"},
  };
  for (const auto& [text, part] : cases) {
    const std::string message = MessageOf(text);
    EXPECT_NE(message.find(part), std::string::npos) << text << " -> " << message;
    EXPECT_NE(message.find("write 'success >= 0.95 @ 95%' or 'P(ate_online_m <= 0.5) >= 0.95 @ 95%'"),
              std::string::npos);
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

}  // namespace
}  // namespace alula::scenarios::statistics
