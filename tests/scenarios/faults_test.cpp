// Faults end to end: what a flight makes of them, and what the command says of bad ones.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "scenarios/runner.h"
#include "tests/scenarios/command.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios {
namespace {

using testing::ReadText;
using testing::TemporaryFolder;

struct Event {
  double time = 0.0;
  std::string source, kind, text;
};

struct Flight {
  Verdict verdict;
  std::vector<Event> events;

  /// When this was said first; −1: never.
  double TimeOf(const std::string& source, const std::string& kind, const std::string& text) const {
    for (const Event& e : events) {
      if (e.source == source && e.kind == kind && e.text.find(text) != std::string::npos) return e.time;
    }
    return -1.0;
  }
};

Flight Hover(const std::string& faults, std::uint64_t seed = 1) {
  const TemporaryFolder folder("hover_fault");
  RunOptions options;
  options.out = folder.path();
  Flight flight{RunScenario(LoadScenario(FindScenario("hover"), {{"faults", faults}}, seed), options), {}};
  std::istringstream lines(ReadText(folder.path() / "events.jsonl"));
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    flight.events.push_back({json["t_s"], json["source"], json["kind"], json["text"]});
  }
  return flight;
}

TEST(FaultyFlights, ALostLinkIsHeldThenLanded) {
  const Flight flight = Hover("[{type: link, direction: both, at: 10 s}]");
  const double holding = flight.TimeOf("autopilot", "mode", "holding");
  const double landing = flight.TimeOf("autopilot", "mode", "landing");
  EXPECT_EQ(flight.TimeOf("fault", "fault_begin", "link"), 10.0);
  EXPECT_GT(holding, 10.4);  // the last command lives for 0.5 s, the last estimate is trusted for 0.5 s
  EXPECT_LT(holding, 10.6);
  EXPECT_NEAR(landing - holding, 3.0, 0.01);  // failsafe.hold_time
  EXPECT_GT(flight.TimeOf("autopilot", "mode", "disarmed"), landing);
  for (const Check& check : flight.verdict.checks) {
    if (check.name != "forbidden_contacts") continue;
    EXPECT_TRUE(check.passed);
  }
}

TEST(FaultyFlights, AWeakMotorIsFlownWithAndAStoppedOneIsNot) {
  EXPECT_EQ(Hover("[{type: motor, motor: 0, thrust: 0.8, when: {height_above: 1 m}}]").verdict.outcome, Outcome::kPass);
  const Flight down = Hover("[{type: motor, motor: 0, when: {height_above: 1 m}}]");
  EXPECT_EQ(down.verdict.outcome, Outcome::kFail);
  EXPECT_EQ(down.verdict.reason, "contact");
}

TEST(FaultyFlights, WhatNeitherStackNorAutopilotUsesChangesNothing) {
  const Flight good = Hover("[]"), bad = Hover("[{type: drop, sensor: imu, at: 5 s}]");
  EXPECT_EQ(good.verdict.digests.at("truth"), bad.verdict.digests.at("truth"));
  EXPECT_EQ(good.verdict.digests.at("commands"), bad.verdict.digests.at("commands"));
  EXPECT_NE(good.verdict.digests.at("events"), bad.verdict.digests.at("events"));
}

/// All kinds at once, at random, in the dark, with one worker and two: one run.
TEST(FaultyFlights, AreOneRunWithOneAndTwoWorkers) {
  const std::string faults =
      "[{type: drop, sensor: camera.*, share: 0.3, at: 1 s, duration: 1 s},"
      " {type: freeze, sensor: camera.right, rate: 1 Hz, duration: 150 ms},"
      " {type: delay, sensor: imu, by: 30 ms, at: 2500 ms, duration: 200 ms},"
      " {type: spike, sensor: camera.left, brightness: 60, share: 0.3, rate: 2 Hz, duration: 300 ms},"
      " {type: lens, sensor: camera.left, obscured: 0.3, at: 2 s, duration: 1 s},"
      " {type: bias, sensor: autopilot.imu, angular_velocity: [0 deg/s, 1 deg/s, 0 deg/s], at: 2 s},"
      " {type: battery, voltage: 0.8, when: {height_above: 0.3 m}},"
      " {type: motor, motor: 1, thrust: 0.9, when: {mode: following}},"
      " {type: computer, factor: 2, at: 1800 ms, duration: 1 s},"
      " {type: link, direction: down, at: 3 s, duration: 100 ms}]";
  const Scenario scenario = LoadScenario(FindScenario("courtyard_gates"),
                                         {{"faults", faults}, {"criteria", "[{type: time_limit, limit: 4 s}]"}}, 3);
  RunOptions one, two;
  two.workers = 2;
  const Verdict first = RunScenario(scenario, one), second = RunScenario(scenario, two);
  EXPECT_NE(first.outcome, Outcome::kFault) << first.message;
  EXPECT_EQ(first.digests, second.digests);
}

TEST(FaultyFlights, BadFaultsAreBadInputOfTheCommand) {
  const auto refused = [](const std::string& faults) {
    const testing::CommandResult run = testing::Alula({"check", "hover", "--set", "faults=" + faults});
    EXPECT_EQ(run.exit_code, 2) << faults;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    return run.err;
  };
  EXPECT_NE(refused("[{type: drop, sensor: camera.left, at: 1 s}]").find("faults.0.sensor: no sensor"),
            std::string::npos);
  EXPECT_NE(refused("[{type: motor, motor: 7, at: 1 s}]").find("faults.0.motor: there is no motor 7"),
            std::string::npos);
  EXPECT_NE(refused("[{type: motor, motor: 0, at: 1 s, rate: 1 Hz}]").find("faults.0.at: begins in more"),
            std::string::npos);
  EXPECT_EQ(testing::Alula({"check", "hover", "--set", "faults=[{type: motor, motor: 3, at: 1 s}]"}).exit_code, 0);
}

}  // namespace
}  // namespace alula::scenarios
