#include "scenarios/campaign/database.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "base/error.h"
#include "scenarios/campaign/case.h"
#include "scenarios/campaign/report.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::campaign {
namespace {

using testing::TemporaryFolder;

Row SomeRow(std::uint64_t seed, const std::string& digest) {
  Row row;
  row.verdict.outcome = Outcome::kFail;
  row.verdict.reason = "landed";
  row.verdict.checks = {AtMost("ate_online", 0.7, 0.5, "m"), AtLeast("gates", NAN, 5, "1")};
  row.verdict.metrics = {{"ate_online_m", 0.7}, {"never_m", INFINITY}};
  row.verdict.digest = digest;
  row.verdict.numeric_class = "here";
  row.verdict.seed = seed;
  row.verdict.scenario = "hover";
  row.parameters["vehicle.mass"] = {"uniform", "0.75 kg", 0.75};
  row.parameters["stack.parameters"] = {"given", "\"quoted, text\"", NAN};
  row.scenario_yaml = "seed: 1\n" + std::string(50'000, ' ') + "meaning: long\n";
  row.program = "build";
  row.wall_s = 1.25;
  return row;
}

TEST(Database, KeepsRowsWholeAndInOrder) {
  const TemporaryFolder folder("database");
  const std::filesystem::path file = folder.path() / "sweep.db";
  {
    Database database(file, Database::Mode::kWrite);
    database.Insert(SomeRow(7, "b"));
    database.Insert(SomeRow(3, "a"));
    EXPECT_THROW(database.Insert(SomeRow(3, "a")), base::FaultError);
    database.SetFact("scenario", "hover");
  }
  const Database database(file, Database::Mode::kRead);
  EXPECT_EQ(database.Fact("scenario"), "hover");
  EXPECT_EQ(database.Fact("nothing"), std::nullopt);
  EXPECT_EQ(database.Seeds(), (std::set<std::uint64_t>{3, 7}));
  const std::vector<Row> rows = database.Rows();
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].verdict.seed, 3U);
  const std::optional<Row> row = database.Find(7);
  ASSERT_TRUE(row);
  const Row wanted = SomeRow(7, "b");
  EXPECT_EQ(ToJson(row->verdict), ToJson(wanted.verdict));
  EXPECT_EQ(row->scenario_yaml, wanted.scenario_yaml);
  EXPECT_EQ(row->parameters.at("vehicle.mass").number, 0.75);
  EXPECT_TRUE(std::isnan(row->parameters.at("stack.parameters").number));
  EXPECT_EQ(row->wall_s, 1.25);
  EXPECT_FALSE(database.Find(8));
  EXPECT_LT(std::filesystem::file_size(file), 60'000U) << "texts are compressed";
}

TEST(Database, MergesAsOftenAsOneLikes) {
  const TemporaryFolder folder("database_merge");
  Database all(folder.path() / "all.db", Database::Mode::kWrite);
  all.Insert(SomeRow(1, "a"));
  const std::filesystem::path part = folder.path() / "part.db";
  {
    Database shard(part, Database::Mode::kWrite);
    shard.Insert(SomeRow(1, "a"));
    shard.Insert(SomeRow(2, "b"));
  }
  EXPECT_EQ(all.Merge(part), 1);
  EXPECT_EQ(all.Merge(part), 0);
  EXPECT_EQ(all.Seeds().size(), 2U);
  const std::filesystem::path other = folder.path() / "other.db";
  {
    Database shard(other, Database::Mode::kWrite);
    shard.Insert(SomeRow(4, "d"));
    shard.Insert(SomeRow(5, "e"));
    shard.Insert(SomeRow(2, "c"));  // the same run with another result
  }
  EXPECT_THROW(all.Merge(other), base::FaultError);
  EXPECT_EQ(all.Seeds().size(), 2U) << "a merge is whole or not at all";
}

TEST(Database, RefusesWhatIsNoSweep) {
  const TemporaryFolder folder("database_bad");
  const std::filesystem::path file = folder.path() / "x.db";
  EXPECT_THROW(Database(file, Database::Mode::kRead), base::InputError);
  std::ofstream(file) << std::string(2000, 'x');
  EXPECT_THROW(Database(file, Database::Mode::kRead), base::InputError);
  EXPECT_THROW(Database(file, Database::Mode::kWrite), base::InputError);
  EXPECT_THROW(Database(folder.path() / "no" / "x.db", Database::Mode::kWrite), base::InputError);
}

TEST(Plan, SurvivesItsFile) {
  SweepPlan plan;
  plan.scenario = "/somewhere/hover.yaml";
  plan.overrides = {{"vehicle.mass", "{uniform: [1 kg, 2 kg]}"}};
  plan.seeds = ParseSeeds("1-3,77");
  plan.order = Order::kSobol;
  plan.grid = {ParseGrid("a.b=[1, 2],{x: 3},\"4,5\"")};
  EXPECT_EQ(plan.seeds, (std::vector<std::uint64_t>{1, 2, 3, 77}));
  EXPECT_EQ(plan.grid[0].values, (std::vector<std::string>{"[1, 2]", "{x: 3}", "\"4,5\""}));
  EXPECT_EQ(plan.Variants(), 3U);
  const std::string text = ToJson(plan);
  EXPECT_EQ(ToJson(PlanFromJson(text)), text);
  EXPECT_THROW(PlanFromJson("{}"), base::InputError);
}

TEST(SweepReport, SeedsAreShortToRead) {
  EXPECT_EQ(SeedsText({9, 1, 2, 3, 5, 6}), "1-3, 5, 6, 9");
  EXPECT_EQ(SeedsText({}), "");
}

TEST(SweepReport, GroupsFailuresByWhatFailed) {
  std::vector<Row> rows = {SomeRow(1, "a"), SomeRow(2, "b"), SomeRow(3, "c"), SomeRow(4, "d")};
  rows[0].verdict.outcome = Outcome::kPass;
  rows[1].verdict.outcome = Outcome::kFault;
  rows[1].verdict.reason = "crash";
  const std::vector<FailureGroup> groups = GroupFailures(rows);
  ASSERT_EQ(groups.size(), 2U);
  EXPECT_EQ(groups[0].failure, "ate_online, gates");
  EXPECT_EQ(groups[0].seeds, (std::vector<std::uint64_t>{3, 4}));
  EXPECT_EQ(groups[1].failure, "crash");
  EXPECT_TRUE(groups[1].fault);
}

}  // namespace
}  // namespace alula::scenarios::campaign
