// `alula replay` as a user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/scenarios/command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios {
namespace {

using testing::Alula;
using testing::CommandResult;
using testing::ReadText;
using testing::TemporaryFolder;

TEST(ReplayCommand, FliesARunOfASweepAgain) {
  const TemporaryFolder folder("replay");
  const std::string sweep = folder.path() / "s", out = folder.path() / "r";
  ASSERT_EQ(Alula({"sweep", "hover", "--seeds", "3-4", "--out", sweep, "--quiet"}).exit_code, 0);
  const CommandResult same = Alula({"replay", sweep + "/sweep.db#4", "--out", out});
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_NE(same.out.find("the same run: digest "), std::string::npos) << same.out;
  EXPECT_EQ(nlohmann::json::parse(ReadText(folder.path() / "r" / "verdict.json"))["seed"], 4);
  // A run folder is a run as well; one whose record is another is told apart, with the second in which they part.
  EXPECT_EQ(Alula({"replay", out, "--out", folder.path() / "again", "--quiet"}).exit_code, 0);
  std::string text = ReadText(folder.path() / "r" / "verdict.json");
  const std::string digest = nlohmann::json::parse(text)["digest"];
  text.replace(text.find(digest), digest.size(), "0123456789abcdef");
  std::ofstream(folder.path() / "r" / "verdict.json") << text;
  const CommandResult other = Alula({"replay", out, "--out", folder.path() / "again"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_NE(other.out.find("recorded 0123456789abcdef"), std::string::npos) << other.out;
}

TEST(ReplayCommand, NamesTheFirstDifferenceOfTwoStacks) {
  const TemporaryFolder folder("replay_diff");
  const std::string a = folder.path() / "a", b = folder.path() / "b";
  ASSERT_EQ(Alula({"run", "hover", "--stack", MISBEHAVING_STACK, "--out", a, "--quiet"}).exit_code, 0);
  ASSERT_EQ(Alula({"run", "hover", "--stack", MISBEHAVING_STACK, "--set", "stack.parameters=setpoint_shift@5:0.01",
                   "--out", b, "--quiet"})
                .exit_code,
            0);
  const CommandResult diff = Alula({"replay", "--diff", a, b, "--json", folder.path() / "diff.json"});
  EXPECT_EQ(diff.exit_code, 1) << diff.err;
  const auto json = nlohmann::json::parse(ReadText(folder.path() / "diff.json"));
  EXPECT_EQ(json["first"]["stream"], "commands");
  EXPECT_EQ(json["first"]["field"], "p_OB.x");
  EXPECT_GE(json["first"]["time_s"], 5.0);
  EXPECT_LT(json["first"]["time_s"], 5.0 + 0.02) << "the first set-point from 5 s on";
  EXPECT_NE(diff.out.find("first difference at 5.0"), std::string::npos) << diff.out;
  EXPECT_EQ(Alula({"replay", "--diff", a, a}).exit_code, 0);
}

TEST(ReplayCommand, BadInputIsOneLine) {
  const TemporaryFolder folder("replay_input");
  const std::string sweep = folder.path() / "s";
  ASSERT_EQ(Alula({"sweep", "hover", "--runs", "1", "--out", sweep, "--quiet"}).exit_code, 0);
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Case> table = {
      {{"replay"}, "runs is required"},
      {{"replay", sweep + "/sweep.db#77"}, "no run of this seed"},
      {{"replay", sweep + "/sweep.db#x"}, "a seed is wanted"},
      {{"replay", sweep + "/sweep.db"}, "sweep.db#137"},
      {{"replay", sweep + "/none.db#1"}, "no such file"},
      {{"replay", folder.path()}, "is no run folder"},
      {{"replay", "--diff", sweep + "/sweep.db#1"}, "--diff wants two runs"},
      {{"replay", sweep + "/sweep.db#1", sweep + "/sweep.db#1"}, "--diff takes two"},
  };
  for (const Case& row : table) {
    const CommandResult result = Alula(row.arguments, {.directory = folder.path()});
    EXPECT_EQ(result.exit_code, 2) << row.message << result.err;
    EXPECT_NE(result.err.find(row.message), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

}  // namespace
}  // namespace alula::scenarios
