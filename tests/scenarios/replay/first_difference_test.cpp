// Whole runs flown against each other.
#include "scenarios/replay/first_difference.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios::replay {
namespace {

namespace fs = std::filesystem;
using base::Time;
using testing::ReadText;
using testing::TemporaryFolder;

constexpr Time kFive{5'000'000'000};
/// Set-points come every 20 ms, and this is the first one from five seconds on.
constexpr Time kFirstRaised{5'005'000'000};

RunCase Hover(const std::vector<base::Override>& overrides = {}, std::uint64_t seed = 1) {
  return {LoadScenario(FindScenario("hover"), overrides, seed), {}, std::nullopt};
}

base::Override Limit(const std::string& limit) { return {"criteria", "[{type: time_limit, limit: " + limit + "}]"}; }

/// Alters what another stack answers.
class AlteredStack : public stack::NavigationStack {
 public:
  using Alter = std::function<void(Time, stack::StackOutput&)>;
  AlteredStack(std::unique_ptr<stack::NavigationStack> inner, Alter alter)
      : inner_(std::move(inner)), alter_(std::move(alter)) {}
  stack::StackOutput Step(Time now, std::span<const stack::Measurement> measurements) override {
    stack::StackOutput output = inner_->Step(now, measurements);
    alter_(now, output);
    return output;
  }

 private:
  std::unique_ptr<stack::NavigationStack> inner_;
  Alter alter_;
};

/// The scenario's own stack, altered.
RunCase Altered(RunCase run, AlteredStack::Alter alter) {
  run.options.stack = [maker = MakerOf(run.scenario.config.stack), alter](const stack::Calibration& calibration,
                                                                          const stack::Mission& mission,
                                                                          std::uint64_t seed, int workers) {
    return std::make_unique<AlteredStack>(maker(calibration, mission, seed, workers), alter);
  };
  return run;
}

/// Every set-point from five seconds on lies a centimetre higher.
void RaiseFromFiveSeconds(Time now, stack::StackOutput& output) {
  if (now < kFive) return;
  for (stack::Command& command : output.commands) {
    if (auto* setpoint = std::get_if<stack::PositionSetpoint>(&command.what)) setpoint->p_OB.z() += 0.01;
  }
}

TEST(FirstDifference, NamesTheSetpointThatDiffersAndItsTime) {
  const RunComparison found = CompareRuns(Hover(), Altered(Hover(), RaiseFromFiveSeconds));
  EXPECT_TRUE(found.config.empty());
  EXPECT_TRUE(found.notes.empty());
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->time, kFirstRaised);
  EXPECT_EQ(found.first->step, 5005);
  EXPECT_EQ(found.first->stream, "commands");
  EXPECT_EQ(found.first->record, "position_setpoint");
  EXPECT_EQ(found.first->field, "p_OB.z");
  EXPECT_NEAR(std::stod(*found.first->b) - std::stod(*found.first->a), 0.01, 1e-12);  // rounding of heights of metres
  const std::string text = ToText(found);
  EXPECT_TRUE(text.starts_with("first difference at 5.005 s (step 5005): commands: position_setpoint.p_OB.z: "))
      << text;
  const nlohmann::json json = nlohmann::json::parse(ToJson(found));
  EXPECT_EQ(json["same"], false);
  EXPECT_EQ(json["first"]["time_s"], 5.005);
  EXPECT_EQ(json["first"]["field"], "p_OB.z");
}

TEST(FirstDifference, EqualRunsHaveNone) {
  const RunComparison found = CompareRuns(Hover({Limit("3 s")}), Hover({Limit("3 s")}));
  EXPECT_FALSE(found.first);
  EXPECT_EQ(ToText(found), "no difference: the two runs are the same in every stream\n");
  EXPECT_EQ(nlohmann::json::parse(ToJson(found))["same"], true);
}

TEST(FirstDifference, OtherSeedsPartAtTheFirstMeasurement) {
  const RunComparison found = CompareRuns(Hover({Limit("2 s")}, 1), Hover({Limit("2 s")}, 2));
  ASSERT_EQ(found.config.size(), 2U);
  EXPECT_EQ(found.config[0].path, "seed");
  EXPECT_EQ(found.config[0].b, "2");
  EXPECT_EQ(found.config[1].path, "vehicle.mass");  // drawn from the seed
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->stream, "measurements");
  EXPECT_LT(found.first->time, Time{} + base::Milliseconds(20));
}

TEST(FirstDifference, ARunThatEndsEarlier) {
  // 2.5 s is inside an interval of digests, 2 s at the end of one.
  for (const char* limit : {"2.5 s", "2 s"}) {
    for (const bool swapped : {false, true}) {
      const RunCase shorter = Hover({Limit(limit)}), longer = Hover({Limit("4 s")});
      const RunComparison found = swapped ? CompareRuns(longer, shorter) : CompareRuns(shorter, longer);
      ASSERT_EQ(found.config.size(), 1U);
      EXPECT_EQ(found.config[0].path, "criteria.0.limit");
      ASSERT_TRUE(found.first) << limit;
      EXPECT_EQ(found.first->time, Time{} + base::Seconds(std::stod(limit)));
      EXPECT_EQ(found.first->stream, "run");
      EXPECT_EQ(swapped ? found.first->b : found.first->a, "time_limit");
      EXPECT_EQ(swapped ? found.first->a : found.first->b, "goes on");
    }
  }
}

TEST(FirstDifference, AStackThatThrowsEndsItsRun) {
  const RunCase throws = Altered(Hover({Limit("3 s")}), [](Time now, stack::StackOutput&) {
    if (now == Time{1'700'000'000}) throw std::runtime_error("lost");
  });
  const RunComparison found = CompareRuns(Hover({Limit("3 s")}), throws);
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->time, Time{1'700'000'000});
  EXPECT_EQ(found.first->b, "stack_exception");
}

TEST(FirstDifference, AnEventThatOneRunHas) {
  const auto speak = [](Time now, stack::StackOutput& output) {
    if (now == Time{1'234'000'000}) output.events.push_back({now, "aside", "by the way"});
  };
  const RunComparison found = CompareRuns(Altered(Hover({Limit("3 s")}), speak), Hover({Limit("3 s")}));
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->record, "aside");
  EXPECT_FALSE(found.first->b);
  EXPECT_EQ(ToText(found),
            "first difference at 1.234 s (step 1234): events: aside: only in A (time 1.234 s, kind \"aside\", text "
            "\"by the way\")\n");
}

TEST(FirstDifference, ASensorThatOneRunLacks) {
  const RunCase a = Hover({Limit("1.5 s")});
  RunCase b = a;
  b.scenario.config.sensors.barometer.reset();
  const RunComparison found = CompareRuns(a, b);
  EXPECT_FALSE(found.config.empty());
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->record, "vehicle0/barometer seq 0");
  EXPECT_FALSE(found.first->b);
}

TEST(FirstDifference, TheFieldThatTheMagnetometerReads) {
  RunCase a = Hover({Limit("0.5 s")});
  a.scenario.config.sensors.magnetometer = sim::MagnetometerConfig{};
  RunCase b = a;
  b.scenario.config.simulation.magnetic_field.declination += 0.1;
  const RunComparison found = CompareRuns(a, b);
  ASSERT_EQ(found.config.size(), 1U);
  EXPECT_EQ(found.config[0].path, "simulation.magnetic_field.declination");
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->time, Time{});
  EXPECT_EQ(found.first->record, "vehicle0/magnetometer seq 0");
  EXPECT_EQ(found.first->field, "magnetic_field.x");
}

TEST(FirstDifference, AnImage) {
  const auto flight = [](const char* highest) {
    const std::vector<base::Override> overrides{Limit("0.2 s"), {"world.sun_elevation_max", highest}};
    return RunCase{LoadScenario(FindScenario("prescribed_flight"), overrides, 1), {}, std::nullopt};
  };
  const RunComparison found = CompareRuns(flight("60 deg"), flight("61 deg"));
  ASSERT_EQ(found.config.size(), 1U);
  EXPECT_EQ(found.config[0].path, "world.sun_elevation_max");
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->stream, "measurements");
  EXPECT_EQ(found.first->record, "vehicle0/camera.left seq 0");
  EXPECT_TRUE(found.first->field.starts_with("pixel (")) << found.first->field;
  EXPECT_NE(found.first->note.find("of 307200 pixels differ"), std::string::npos) << found.first->note;
}

TEST(FirstDifference, AStackThatDoesNotRepeatItselfCannotBeCompared) {
  int flights = 0;
  RunCase a = Hover({Limit("2 s")});
  a.options.stack = [&flights, maker = MakerOf(a.scenario.config.stack)](const stack::Calibration& calibration,
                                                                         const stack::Mission& mission,
                                                                         std::uint64_t seed, int workers) {
    const int flight = ++flights;
    return std::make_unique<AlteredStack>(maker(calibration, mission, seed, workers),
                                          [flight](Time now, stack::StackOutput& output) {
                                            if (now == Time{})
                                              output.events.push_back({now, "flight", std::to_string(flight)});
                                          });
  };
  try {
    CompareRuns(a, Hover({Limit("2 s")}));
    FAIL();
  } catch (const base::FaultError& e) {
    EXPECT_EQ(e.reason(), "not_deterministic");
  }
}

/// Flies a case into a folder; the case that the folder then holds.
RunCase Recording(RunCase run, const fs::path& folder) {
  RunOptions options = run.options;
  options.out = folder;
  RunScenario(run.scenario, options);
  return CaseOfFolder(folder, run.options);
}

TEST(FirstDifference, RunFoldersWithEqualDigestsAreNotFlown) {
  const TemporaryFolder folder("replay_equal");
  RunCase a = Recording(Hover({Limit("2 s")}), folder.path() / "a");
  RunCase b = Recording(Hover({Limit("2 s")}), folder.path() / "b");
  EXPECT_EQ(a.scenario.name, "hover");
  EXPECT_EQ(a.recorded->rows.size(), 2U);
  for (RunCase* run : {&a, &b}) run->options.progress = [](Time) { FAIL() << "was flown"; };
  EXPECT_FALSE(CompareRuns(a, b).first);
}

TEST(FirstDifference, RunFoldersAreFlownNoFurtherThanTheyPart) {
  const TemporaryFolder folder("replay_folders");
  RunCase a = Recording(Hover(), folder.path() / "a");
  RunCase b = Recording(Altered(Hover(), RaiseFromFiveSeconds), folder.path() / "b");
  Time latest;
  for (RunCase* run : {&a, &b}) run->options.progress = [&latest](Time t) { latest = std::max(latest, t); };
  const RunComparison found = CompareRuns(a, b);
  EXPECT_TRUE(found.notes.empty()) << found.notes.front();
  ASSERT_TRUE(found.first);
  EXPECT_EQ(found.first->time, kFirstRaised);
  EXPECT_LE(latest, kFive + base::Seconds(1.0));
}

TEST(FirstDifference, ARecordingOfAnotherBuildIsSaidSoAndFlownAgain) {
  const TemporaryFolder folder("replay_stale");
  RunCase a = Recording(Hover({Limit("7 s")}), folder.path() / "a");
  const RunCase b = Altered(Hover({Limit("7 s")}), RaiseFromFiveSeconds);
  a.recorded->numeric_class = "an older one";
  for (std::size_t i = 2; i < a.recorded->rows.size(); ++i) ++a.recorded->rows[i].streams[0];
  for (const bool swapped : {false, true}) {
    const RunComparison found = swapped ? CompareRuns(b, a) : CompareRuns(a, b);
    ASSERT_TRUE(found.first);
    EXPECT_EQ(found.first->time, kFirstRaised);
    ASSERT_EQ(found.notes.size(), 1U);
    EXPECT_NE(found.notes[0].find(swapped ? "B, flown again, is not" : "A, flown again, is not"), std::string::npos);
    EXPECT_NE(found.notes[0].find("(the same up to 2.000 s)"), std::string::npos) << found.notes[0];
    EXPECT_NE(found.notes[0].find("recorded by numeric class an older one, flown by cpu"), std::string::npos);
  }
}

TEST(FirstDifference, WhatIsNoRunFolderIsBadInput) {
  const TemporaryFolder folder("replay_bad");
  EXPECT_THROW(CaseOfFolder(folder.path(), {}), base::InputError);
  Recording(Hover({Limit("0.1 s")}), folder.path() / "a");
  std::ofstream(folder.path() / "a" / "verdict.json") << "{\"outcome\":";
  EXPECT_THROW(CaseOfFolder(folder.path() / "a", {}), base::InputError);
}

TEST(IntervalDigests, TheLastRowIsTheRunsDigest) {
  const TemporaryFolder folder("replay_rows");
  RunCase run = Hover({Limit("2.5 s")});
  std::vector<sim::DigestRow> told;
  run.options.interval_digest = [&told](const sim::DigestRow& row) { told.push_back(row); };
  run.options.out = folder.path();
  const Verdict verdict = RunScenario(run.scenario, run.options);
  EXPECT_EQ(sim::ReadDigests(folder.path() / sim::kDigestsFile), told);
  ASSERT_EQ(told.size(), 3U);
  const std::string text = ReadText(folder.path() / sim::kDigestsFile);
  const std::string last = text.substr(text.rfind("2.500000000,"));
  for (const auto& [stream, digest] : verdict.digests) EXPECT_NE(last.find(digest), std::string::npos) << stream;
}

TEST(IntervalDigests, ARunThatWasKilledLeavesItsWholeIntervals) {
  const TemporaryFolder folder("replay_killed");
  const RunCase run = Hover();
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    RunOptions options;
    options.out = folder.path();
    options.progress = [](Time time) {
      if (time == Time{3'500'000'000}) ::kill(::getpid(), SIGKILL);
    };
    RunScenario(run.scenario, options);
    std::_Exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  const std::vector<sim::DigestRow> rows =
      sim::ReadDigests(folder.path() / (".partial-" + std::to_string(child)) / sim::kDigestsFile);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows.back().time, Time{3'000'000'000});
}

}  // namespace
}  // namespace alula::scenarios::replay
