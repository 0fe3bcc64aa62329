#include "scenarios/replay/config_difference.h"

#include <gtest/gtest.h>

namespace alula::scenarios::replay {
namespace {

ScenarioConfig Hover(const std::vector<base::Override>& overrides) {
  return LoadScenario(FindScenario("hover"), overrides, 1).config;
}

TEST(DifferentKeys, NamesKeysAndValuesAsTheFileHasThem) {
  const std::vector<ConfigDifference> found =
      DifferentKeys(Hover({}), Hover({{"stack.dwell", "13 s"},
                                      {"meaning", "something else"},
                                      {"mission.waypoints", "[[0 m, 0 m, 1.5 m], [1 m, 0 m, 1.5 m]]"}}));
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].path, "mission.waypoints.1");
  EXPECT_EQ(found[0].a, "absent");
  EXPECT_EQ(found[0].b, "[1 m, 0 m, 1.5 m]");
  EXPECT_EQ(found[1].path, "stack.dwell");
  EXPECT_EQ(found[1].a, "12 s");
  EXPECT_EQ(found[1].b, "13 s");
}

TEST(DifferentKeys, KeysThatOnlyOneHas) {
  ScenarioConfig without = Hover({});
  without.sensors.position_reference.reset();
  const std::vector<ConfigDifference> found = DifferentKeys(without, Hover({}));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].path, "sensors.position_reference");
  EXPECT_NE(found[0].b.find("rate: 50 Hz"), std::string::npos) << found[0].b;
  EXPECT_TRUE(DifferentKeys(without, without).empty());
}

}  // namespace
}  // namespace alula::scenarios::replay
