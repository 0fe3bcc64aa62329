#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/trajectory_file.h"
#include "tests/scenarios/command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios {
namespace {

namespace fs = std::filesystem;
using testing::Alula;
using testing::CommandResult;

/// A few seconds through the courtyard.
std::vector<std::string> ShortFlight(std::vector<std::string> more) {
  std::vector<std::string> words{"slam",
                                 "prescribed_flight",
                                 "--quiet",
                                 "--set",
                                 "stack.type=slam",
                                 "--set",
                                 "criteria=[{type: time_limit, limit: 6 s}]"};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(SlamCommand, WatchesAFlightWithTwoEstimators) {
  const testing::TemporaryFolder folder("slam");
  const fs::path out = fs::path(folder.path()) / "out", json = fs::path(folder.path()) / "figures.json";
  const CommandResult result = Alula(
      ShortFlight({"--variant", "odometry:map.enabled=false", "--variant", "whole", "--out", out, "--json", json}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("odometry"), std::string::npos);

  std::ifstream stream(json);
  const nlohmann::json report = nlohmann::json::parse(stream)[0];
  EXPECT_EQ(report["name"], "prescribed_flight");
  ASSERT_EQ(report["estimators"].size(), 2U);
  for (const auto& one : report["estimators"]) {
    const auto& figures = one["figures"];
    EXPECT_GT(figures["completeness_online"].get<double>(), 0.7) << one;  // the first second it stands
    EXPECT_LT(figures["ate_online_m"].get<double>(), 0.05);
    EXPECT_LT(figures["ate_final_m"].get<double>(), 0.05);
    EXPECT_LT(figures["ate_unaligned_online_m"].get<double>(), 0.6);  // the start is known to 0.1 m and 2°
    EXPECT_GT(figures["frame_median_ms"].get<double>(), 0.1);
    EXPECT_EQ(figures["resets"], 0);
  }
  const auto truth = base::ReadTrajectory(out / "1" / "truth.tum");
  EXPECT_GT(truth.size(), 1000U);  // 200 Hz
  for (const char* name : {"odometry", "whole"}) {
    EXPECT_GT(base::ReadTrajectory(out / "1" / name / "estimate.tum").size(), 80U);
    EXPECT_GT(base::ReadTrajectory(out / "1" / name / "estimate_final.tum").size(), 80U);
  }
}

TEST(SlamCommand, WatchesARecordingOfOurOwn) {
  const testing::TemporaryFolder folder("slam");
  const std::string data = fs::path(folder.path()) / "data";
  const CommandResult made = Alula(
      {"export", "prescribed_flight", "--quiet", "--out", data, "--set", "criteria=[{type: time_limit, limit: 5 s}]"});
  ASSERT_TRUE(fs::is_directory(data)) << made.err;
  const fs::path out = fs::path(folder.path()) / "out";
  const CommandResult result = Alula({"slam", data, "--quiet", "--json", "-", "--out", out});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const nlohmann::json figures = nlohmann::json::parse(result.out)[0]["estimators"][0]["figures"];
  EXPECT_LT(figures["ate_online_m"].get<double>(), 0.05);
  EXPECT_TRUE(fs::is_regular_file(out / "slam.json"));
}

TEST(SlamCommand, BadInputIsOneLine) {
  const testing::TemporaryFolder folder("slam");
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"slam"}, "sources are required"},
      {{"slam", "no_such_flight"}, "no scenario is called"},
      {{"slam", "prescribed_flight"}, "its stack is not of type slam"},
      {{"slam", folder.path()}, ""},
      {ShortFlight({"--variant", "a:odometry.windw.frames=3"}), "odometry.windw"},
      {ShortFlight({"--variant", "a", "--variant", "a"}), "two of this name"},
      {ShortFlight({"--variant", "a/b"}), "letters, digits"},
      {ShortFlight({"--variant", "a:frames"}), "NAME:key=value"},
  };
  for (const auto& [words, expected] : cases) {
    const CommandResult result = Alula(words);
    EXPECT_EQ(result.exit_code, 2) << words.back();
    EXPECT_NE(result.err.find(expected), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace alula::scenarios
