// `alula sweep` as a user meets it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "scenarios/campaign/database.h"
#include "tests/scenarios/command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::campaign {
namespace {

namespace fs = std::filesystem;
using scenarios::testing::Alula;
using scenarios::testing::CommandResult;
using scenarios::testing::ReadText;
using scenarios::testing::TemporaryFolder;

std::vector<Row> RowsOf(const fs::path& folder) { return Database(folder / "sweep.db", Database::Mode::kRead).Rows(); }

/// What must be the same in two sweeps of the same runs.
std::vector<std::string> Results(const fs::path& folder) {
  std::vector<std::string> results;
  for (const Row& row : RowsOf(folder)) results.push_back(ToJson(row.verdict));
  return results;
}

TEST(Sweep, FliesEachSeedAsRunDoes) {
  const TemporaryFolder folder("sweep");
  const fs::path out = folder.path() / "s";
  const CommandResult sweep = Alula({"sweep", "hover", "--seeds", "3-6", "--out", out, "--jobs", "2"});
  EXPECT_EQ(sweep.exit_code, 0) << sweep.out << sweep.err;
  EXPECT_NE(sweep.out.find("hover: 4 of 4 pass (100.0 %, 95 % interval 39.8 to 100.0 %"), std::string::npos)
      << sweep.out;
  EXPECT_NE(sweep.err.find("hover: 4/4: 4 pass, 0 fail, 0 fault"), std::string::npos) << sweep.err;
  const std::vector<Row> rows = RowsOf(out);
  ASSERT_EQ(rows.size(), 4U);
  for (const Row& row : rows) {
    const fs::path alone = folder.path() / "alone";
    ASSERT_EQ(Alula({"run", "hover", "--seed", std::to_string(row.verdict.seed), "--out", alone}).exit_code, 0);
    EXPECT_EQ(nlohmann::json::parse(ReadText(alone / "verdict.json"))["digest"], row.verdict.digest);
    EXPECT_EQ(row.parameters.at("vehicle.mass").kind, "uniform");
    EXPECT_GT(row.wall_s, 0.0);
    EXPECT_GT(row.peak_memory_mb, 5.0);
  }
  EXPECT_FALSE(fs::exists(out / "runs")) << "passed runs are not kept";
  EXPECT_FALSE(fs::exists(out / ".work"));
  const std::optional<Row> whole = Database(out / "sweep.db", Database::Mode::kRead).Find(4);
  ASSERT_TRUE(whole);
  EXPECT_NE(whole->scenario_yaml.find("seed: 4\n"), std::string::npos);
  EXPECT_NE(whole->interval_digests.find("time_s,truth"), std::string::npos);
}

TEST(Sweep, KilledAtAnyMomentItGoesOn) {
  const TemporaryFolder folder("sweep_killed");
  const fs::path whole = folder.path() / "whole", killed = folder.path() / "killed";
  ASSERT_EQ(Alula({"sweep", "hover", "--runs", "10", "--out", whole, "--quiet"}).exit_code, 0);
  for (const int milliseconds : {120, 350, 480, 700}) {
    const pid_t child = ::fork();
    if (child == 0) {
      const int nowhere = ::open("/dev/null", O_RDWR);
      ::dup2(nowhere, STDOUT_FILENO);
      ::dup2(nowhere, STDERR_FILENO);
      ::execl(ALULA_BINARY, "alula", "sweep", "hover", "--runs", "10", "--out", killed.c_str(), nullptr);
      std::_Exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));  // any moment will do
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  const CommandResult last = Alula({"sweep", "hover", "--runs", "10", "--out", killed, "--json", "-"});
  EXPECT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(Results(whole), Results(killed));
  EXPECT_FALSE(fs::exists(killed / "runs"));
  const CommandResult again = Alula({"sweep", "hover", "--runs", "10", "--out", killed, "--json", "-"});
  EXPECT_EQ(nlohmann::json::parse(again.out)["flown"], 0) << "nothing is flown twice";
}

TEST(Sweep, TakesOverFoldersThatHaveNoRow) {
  const TemporaryFolder folder("sweep_adopt");
  const fs::path out = folder.path() / "s";
  const std::vector<std::string> arguments = {
      "sweep", "hover", "--stack", MISBEHAVING_STACK, "--grid", "stack.parameters=\"\",segfault@1", "--keep",
      "all",   "--out", out,       "--json",          "-"};
  EXPECT_EQ(Alula(arguments).exit_code, 3);
  const std::vector<std::string> before = Results(out);
  fs::remove(out / "sweep.db");  // as if it had been killed before it wrote the rows
  const CommandResult again = Alula(arguments);
  EXPECT_EQ(again.exit_code, 3) << again.err;
  EXPECT_EQ(nlohmann::json::parse(again.out)["flown"], 0);
  EXPECT_EQ(Results(out), before);
}

TEST(Sweep, MisbehaviourIsARowAndTheSweepGoesOn) {
  const TemporaryFolder folder("sweep_bad");
  const fs::path out = folder.path() / "s";
  const CommandResult sweep =
      Alula({"sweep", "hover", "--stack", MISBEHAVING_STACK, "--grid",
             "stack.parameters=\"\",throw@1,segfault@1,abort@1,exit@1,hang@1,memory@1", "--out", out, "--hang-limit",
             "8", "--memory-limit", "400", "--set", "criteria=[{type: time_limit, limit: 3 s}]", "--junit",
             folder.path() / "junit.xml"});
  EXPECT_EQ(sweep.exit_code, 3) << sweep.out << sweep.err;
  std::map<std::string, std::string> reasons;
  for (const Row& row : RowsOf(out)) {
    const std::string habit = row.parameters.at("stack.parameters").value;
    reasons[habit] = row.verdict.reason;
    if (habit == "\"\"") continue;
    EXPECT_EQ(row.verdict.outcome, Outcome::kFault) << habit;
    EXPECT_TRUE(fs::exists(out / "runs" / std::to_string(row.verdict.seed) / "events.jsonl")) << habit;
  }
  const std::map<std::string, std::string> expected = {{"\"\"", "time_limit"},  {"throw@1", "stack_exception"},
                                                       {"segfault@1", "crash"}, {"abort@1", "crash"},
                                                       {"exit@1", "exit"},      {"hang@1", "hang"},
                                                       {"memory@1", "memory"}};
  EXPECT_EQ(reasons, expected);
  const std::string junit = ReadText(folder.path() / "junit.xml");
  EXPECT_NE(junit.find("tests=\"7\" failures=\"1\" errors=\"6\""), std::string::npos) << junit;
}

TEST(Sweep, ParametersComeFromGridsListsAndOrders) {
  const TemporaryFolder folder("sweep_parameters");
  const std::string mass = "vehicle.mass={uniform: [0.72 kg, 0.78 kg]}";
  const auto masses = [&](const std::vector<std::string>& more) {
    const fs::path out = folder.path() / "s";
    std::vector<std::string> arguments = {"sweep", "hover", "--fresh", "--quiet", "--out", out};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const CommandResult sweep = Alula(arguments);
    EXPECT_EQ(sweep.exit_code, 0) << sweep.err;
    std::vector<double> numbers;
    for (const Row& row : RowsOf(out)) numbers.push_back(row.parameters.at("vehicle.mass").number);
    return numbers;
  };
  EXPECT_EQ(masses({"--grid", "vehicle.mass=0.73 kg,0.74 kg", "--grid", "stack.cruise_speed=1 m/s,1.2 m/s"}),
            (std::vector<double>{0.73, 0.74, 0.73, 0.74}));
  std::ofstream(folder.path() / "list.csv") << "vehicle.mass, stack.cruise_speed\n0.75 kg, 1 m/s\n0.76 kg, 1.2 m/s\n";
  EXPECT_EQ(masses({"--list", folder.path() / "list.csv"}), (std::vector<double>{0.75, 0.76}));
  for (const char* order : {"lhs", "sobol"}) {
    std::vector<double> spread = masses({"--order", order, "--runs", "4", "--set", mass});
    std::sort(spread.begin(), spread.end());
    for (std::size_t i = 0; i < 4; ++i) {  // one in each quarter
      EXPECT_GE(spread[i], 0.72 + 0.015 * static_cast<double>(i)) << order;
      EXPECT_LE(spread[i], 0.735 + 0.015 * static_cast<double>(i)) << order;
    }
  }
}

TEST(Sweep, RequirementsStopItAndSayHow) {
  const TemporaryFolder folder("sweep_require");
  const auto sweep = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {
        "sweep", "hover", "--quiet", "--out", folder.path() / "s", "--json", folder.path() / "json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const int exit_code = Alula(arguments).exit_code;
    return std::pair(exit_code, nlohmann::json::parse(ReadText(folder.path() / "json")));
  };
  const auto [good, confirmed] = sweep({"--require", "success >= 0.5 @ 90%"});
  EXPECT_EQ(good, 0);
  EXPECT_EQ(confirmed["requirements"][0]["decision"], "confirmed");
  EXPECT_LT(confirmed["runs"], 20);
  const auto [bad, rejected] = sweep({"--require", "P(hover_rms_m <= 1e-9) >= 0.5 @ 90%"});
  EXPECT_EQ(bad, 1);
  EXPECT_EQ(rejected["requirements"][0]["decision"], "rejected");
  const auto [open, undecided] = sweep({"--require", "success >= 0.99 @ 99%", "--runs", "3"});
  EXPECT_EQ(open, 4);
  EXPECT_EQ(undecided["requirements"][0]["decision"], "undecided");
}

TEST(Sweep, BadInputIsOneLine) {
  const TemporaryFolder folder("sweep_input");
  const std::string out = folder.path() / "s";
  ASSERT_EQ(Alula({"sweep", "hover", "--runs", "2", "--out", out, "--quiet"}).exit_code, 0);
  std::ofstream(folder.path() / "list.csv") << "vehicle.mass\n1 kg, 2 kg\n";
  std::ofstream(folder.path() / "text.db") << "this is no database, it is a text of more than a hundred bytes; SQLite "
                                              "looks at the first page of a file and finds no header there";
  const std::string text_db = folder.path() / "text.db";
  struct Case {
    std::vector<std::string> arguments;
    std::string message;
  };
  const std::vector<Case> table = {
      {{"sweep"}, "scenario is required"},
      {{"sweep", "hoover"}, "did you mean `hover`?"},
      {{"sweep", "hover", "--jobs", "0"}, "--jobs"},
      {{"sweep", "hover", "--runs", "0"}, "--runs"},
      {{"sweep", "hover", "--seeds", "5-3"}, "`5-3` is no range"},
      {{"sweep", "hover", "--seeds", "1-3,2"}, "2 is named twice"},
      {{"sweep", "hover", "--seeds", "1-3", "--runs", "4"}, "leave out --runs"},
      {{"sweep", "hover", "--require", "happiness >= 1"}, "success >= 0.95 @ 95%"},
      {{"sweep", "hover", "--grid", "vehicle.mass"}, "path.to.key=value,value"},
      {{"sweep", "hover", "--grid", "vehicle.mas=1 kg,2 kg"}, "unknown key"},
      {{"sweep", "hover", "--list", folder.path() / "none.csv"}, "cannot be read"},
      {{"sweep", "hover", "--list", folder.path() / "list.csv"}, "list.csv:2:1: has 2 values"},
      {{"sweep", "hover", "--runs", "2", "--set", "vehicle.mass=0.7 kg", "--out", out},
       "`mass: 0.7 kg` now); name another --out"},
      {{"sweep", "hover", "--engine", "cloud"}, "--engine"},
      {{"sweep", "hover", "--watch"}, "go with --engine slurm"},
      {{"sweep", "--compare", text_db, text_db}, "is no database of a sweep"},
      {{"sweep", "hover", "--order", "sobol", "--set", "vehicle.mass=0.7 kg"}, "is a distribution"},
      {{"sweep", "hover", "--stack", "none.so"}, "none.so"},
  };
  for (const Case& row : table) {
    std::vector<std::string> arguments = row.arguments;
    const bool has_out = std::find(arguments.begin(), arguments.end(), "--out") != arguments.end();
    if (!has_out) arguments.insert(arguments.end(), {"--out", folder.path() / "other"});
    const CommandResult result = Alula(arguments);
    EXPECT_EQ(result.exit_code, 2) << row.message << result.err;
    EXPECT_NE(result.err.find(row.message), std::string::npos) << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  }
}

TEST(Sweep, OneFolderOneSweep) {
  const TemporaryFolder folder("sweep_lock");
  const int lock = ::open((folder.path() / "sweep.lock").c_str(), O_RDWR | O_CREAT, 0644);
  ASSERT_EQ(::flock(lock, LOCK_EX | LOCK_NB), 0);
  const CommandResult second = Alula({"sweep", "hover", "--runs", "1", "--out", folder.path()});
  ::close(lock);
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("another sweep is at work"), std::string::npos) << second.err;
}

TEST(Sweep, CtrlCLosesNothingThatWasFlown) {
  const TemporaryFolder folder("sweep_interrupt");
  const std::vector<std::string> arguments = {"sweep", "hover", "--runs", "40", "--out", folder.path() / "s"};
  const CommandResult stopped = Alula(arguments, {.interrupt_when_err_has_lines = 1});
  EXPECT_EQ(stopped.exit_code, 130);
  EXPECT_NE(stopped.err.find("runs are safe; the same command goes on"), std::string::npos) << stopped.err;
  const std::size_t there = RowsOf(folder.path() / "s").size();
  EXPECT_GE(there, 2U);
  EXPECT_LT(there, 40U);
  EXPECT_EQ(Alula(arguments).exit_code, 0);
  EXPECT_EQ(RowsOf(folder.path() / "s").size(), 40U);
}

}  // namespace
}  // namespace alula::scenarios::campaign
