#include "scenarios/plugin/plugin_stack.h"

#include <gtest/gtest.h>

#include <cfenv>
#include <fstream>
#include <opencv2/core/utility.hpp>

#include "base/error.h"
#include "scenarios/plugin/internal/float_state.h"
#include "scenarios/runner.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios {
namespace {

using testing::TemporaryFolder;

const std::string kSilent = std::string(SILENT_STACK_FOLDER) + "/silent_stack_";

Scenario Hover(const std::string& library, const std::string& parameters = "") {
  Scenario scenario = LoadScenario(FindScenario("hover"), {}, 1);
  auto& plugin = scenario.config.stack.emplace<PluginConfig>();
  plugin.library = library;
  plugin.parameters = parameters;
  return scenario;
}

Verdict Misbehave(const std::string& habit) { return RunScenario(Hover(MISBEHAVING_STACK, habit), {}); }

/// The message of the InputError that a library is refused with.
std::string Refusal(const std::string& library, const std::string& parameters = "") {
  try {
    RunScenario(Hover(library, parameters), {});
  } catch (const base::InputError& e) {
    return e.what();
  }
  return "was not refused";
}

/// The scenario's own stack behind the boundary.
Scenario BehindTheBoundary(Scenario scenario) {
  const std::string all = base::DumpConfig(scenario.config);
  const std::size_t begin = all.find("\nstack:\n") + 1;
  std::size_t end = all.find('\n', begin) + 1;
  while (all[end] == ' ') end = all.find('\n', end) + 1;
  auto& plugin = scenario.config.stack.emplace<PluginConfig>();
  plugin.library = HOUSE_STACK;
  plugin.parameters = all.substr(begin, end - begin);
  return scenario;
}

void ExpectSameRun(const Scenario& scenario) {
  const Verdict inside = RunScenario(scenario, {});
  const Verdict behind = RunScenario(BehindTheBoundary(scenario), {});
  EXPECT_EQ(behind.digests, inside.digests);
  EXPECT_EQ(behind.digest, inside.digest);
  EXPECT_EQ(behind.metrics, inside.metrics);
  EXPECT_EQ(behind.outcome, inside.outcome);
}

TEST(PluginStack, NothingIsLostAtTheBoundary) { ExpectSameRun(LoadScenario(FindScenario("hover"), {}, 1)); }

// The first seconds: images, IMU, estimates with full covariances, jobs on threads, and the gates of a mission.
TEST(PluginStack, NothingOfAVisualInertialStackIsLostAtTheBoundary) {
  cv::setNumThreads(1);
  ExpectSameRun(LoadScenario(FindScenario("courtyard_gates"), {{"criteria", "[{type: time_limit, limit: 4 s}]"}}, 1));
}

// A stack that declares latencies is slowed behind the boundary as it is inside; one without the symbol is left alone.
TEST(PluginStack, ASlowComputerCrosses) {
  cv::setNumThreads(1);
  const std::vector<base::Override> slow{{"criteria", "[{type: time_limit, limit: 3 s}]"},
                                         {"faults", "[{type: computer, factor: 4, at: 1500 ms}]"}};
  const Scenario scenario = LoadScenario(FindScenario("courtyard_gates"), slow, 1);
  ExpectSameRun(scenario);
  Scenario prompt = scenario;
  prompt.config.faults.clear();
  EXPECT_NE(RunScenario(scenario, {}).digests.at("estimates"), RunScenario(prompt, {}).digests.at("estimates"));

  const TemporaryFolder folder("slow_silent");
  Scenario silent = Hover(kSilent + "none.so");
  silent.config.criteria = LoadScenario(FindScenario("hover"), slow, 1).config.criteria;
  silent.config.faults = scenario.config.faults;
  RunOptions options;
  options.out = folder.path();
  RunScenario(silent, options);
  EXPECT_NE(testing::ReadText(folder.path() / "events.jsonl").find("fault_ignored"), std::string::npos);
}

TEST(PluginStack, FilesAndTimesCross) {
  const TemporaryFolder folder("plugin_files");
  RunOptions options;
  options.out = folder.path();
  const Scenario scenario = BehindTheBoundary(
      LoadScenario(FindScenario("courtyard_gates"), {{"criteria", "[{type: time_limit, limit: 2 s}]"}}, 1));
  RunScenario(scenario, options);
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "map.bt"));
  EXPECT_NE(testing::ReadText(folder.path() / "timing.json").find("stack/odometry"), std::string::npos);
}

TEST(PluginStack, ResolvedScenarioReadsBackToTheSameLibraryAndText) {
  const Scenario scenario = Hover(MISBEHAVING_STACK, "setpoint_shift@5:0.01\n\"@ ü\"");
  const TemporaryFolder folder("plugin_resolved");
  std::ofstream(folder.path() / "again.yaml") << base::DumpConfig(scenario.config);
  const Scenario again = LoadScenario(folder.path() / "again.yaml", {}, std::nullopt);
  EXPECT_EQ(std::get<PluginConfig>(again.config.stack).library, MISBEHAVING_STACK);
  EXPECT_EQ(std::get<PluginConfig>(again.config.stack).parameters, "setpoint_shift@5:0.01\n\"@ ü\"");
}

TEST(PluginStack, OverrideReplacesAStackWithKeysOfItsOwn) {
  const Scenario scenario =
      LoadScenario(FindScenario("hover"), {StackOverride("a: \"b\" #.so"), {"stack.parameters", "throw@5"}}, 1);
  const auto& plugin = std::get<PluginConfig>(scenario.config.stack);
  EXPECT_EQ(plugin.library, std::filesystem::absolute("a: \"b\" #.so"));
  EXPECT_EQ(plugin.parameters, "throw@5");
  EXPECT_NO_THROW(LoadScenario(FindScenario("courtyard_gates"), {StackOverride("lib.so")}, 1));
}

TEST(PluginStack, LibraryIsLookedForBesideTheFileThatNamesIt) {
  const TemporaryFolder folder("plugin_path");
  std::ofstream(folder.path() / "mine.yaml") << "extends: hover\nstack:\n  type: plugin\n  library: ./none.so\n";
  const std::string file = folder.path() / "mine.yaml";
  try {
    TryToBuild(LoadScenario(file, {}, std::nullopt));
    FAIL() << "a missing library was accepted";
  } catch (const base::InputError& e) {
    EXPECT_EQ(std::string(e.what()), file + ":4:12: stack.library: `" + (folder.path() / "none.so").string() +
                                         "` does not exist; is the name right?");
  }
}

TEST(PluginStack, LibrariesThatAreNoneAreRefused) {
  const TemporaryFolder folder("plugin_refused");
  const std::string text = folder.path() / "text.so";
  std::ofstream(text) << "this is no library\n";
  EXPECT_EQ(Refusal(folder.path()),
            "stack.library: `" + folder.path().string() + "` is no file; a shared library is wanted");
  EXPECT_EQ(Refusal(text),
            "stack.library: `" + text + "` cannot be loaded as a shared library: " + text + ": file too short");
  EXPECT_EQ(Refusal(kSilent + "symbol.so"), "stack.library: `" + kSilent +
                                                "symbol.so` exports no `alula_stack_plugin`; stack/interface/plugin.h "
                                                "says how");
}

TEST(PluginStack, LibrariesOfAnotherAbiAreRefused) {
  EXPECT_EQ(Refusal(kSilent + "version.so"),
            "stack.library: `" + kSilent +
                "version.so` was built for version 3 of plugin.h; this Alula speaks version 2: build it again with "
                "stack/interface/plugin.h of this one");
  EXPECT_NE(Refusal(kSilent + "layout.so").find("lays out the structs of plugin.h differently"), std::string::npos);
  EXPECT_NE(Refusal(kSilent + "step.so").find("has no `step` in its table"), std::string::npos);
}

TEST(PluginStack, StackInCThatDoesNothingStaysOnTheGround) {
  const Verdict verdict = RunScenario(Hover(kSilent + "none.so"), {});
  EXPECT_EQ(verdict.outcome, Outcome::kFail);
  EXPECT_EQ(verdict.reason, "time_limit");
}

TEST(PluginStack, WhatTheStackCannotFlyIsBadInput) {
  EXPECT_NE(Refusal(MISBEHAVING_STACK, "sneeze@5").find("stack: stack.parameters names no habit"), std::string::npos);
  EXPECT_NE(Refusal(HOUSE_STACK, "stack: {type: visual_inertial}").find("stereo"), std::string::npos);
  EXPECT_NE(Refusal(HOUSE_STACK, "stack: {type: position_relay").find("stack.parameters:1"), std::string::npos);
  EXPECT_NE(Refusal(HOUSE_STACK, "stack: {type: position_relay, dwell: 3 m}").find("dwell"), std::string::npos);
}

TEST(PluginStack, FailuresAreFaultsWithTheirText) {
  const auto expect = [](const std::string& habit, const std::string& reason, const std::string& message) {
    const Verdict verdict = Misbehave(habit);
    EXPECT_EQ(verdict.outcome, Outcome::kFault) << habit;
    EXPECT_EQ(verdict.reason, reason) << habit;
    EXPECT_EQ(verdict.message, message) << habit;
  };
  expect("error@2", "stack_exception", "lost the map");
  expect("throw@2", "stack_exception", "keyframe 17");
  expect("oddly@2", "stack_exception", "the stack threw something that is no std::exception");
  expect("kind@2", "stack_exception", "the stack's answer: a command of kind 99; there are 0 to 6");
  expect("nan@2", "stack_nan", "the stack's estimate.X_OB is not finite");
}

TEST(PluginStack, ShiftedSetpointChangesCommandsFromItsTimeOn) {
  const Verdict plain = Misbehave("");
  const Verdict shifted = Misbehave("setpoint_shift@5:0.01");
  EXPECT_EQ(plain.outcome, Outcome::kPass);
  EXPECT_EQ(shifted.outcome, Outcome::kPass);
  EXPECT_NE(shifted.digests.at("commands"), plain.digests.at("commands"));
  EXPECT_EQ(Misbehave("setpoint_shift@50:0.01").digest, plain.digest);  // it has landed by then
}

TEST(PluginStack, RoundingOfALibraryDoesNotReachTheSimulation) {
  EXPECT_EQ(Misbehave("round@2").digest, Misbehave("").digest);
  EXPECT_EQ(std::fegetround(), FE_TONEAREST);
#if defined(__SSE__)
  constexpr unsigned kFlushToZero = 0x8000;
  {
    const plugin::KeepFloatState keep;
    _mm_setcsr(_mm_getcsr() | kFlushToZero);  // as the start-up code of -ffast-math does
  }
  EXPECT_EQ(_mm_getcsr() & kFlushToZero, 0u);
#endif
}

TEST(PluginStack, HashTellsLibrariesApart) {
  EXPECT_EQ(HashOfLibrary(HOUSE_STACK).size(), 16u);
  EXPECT_EQ(HashOfLibrary(HOUSE_STACK), HashOfLibrary(HOUSE_STACK));
  EXPECT_NE(HashOfLibrary(kSilent + "none.so"), HashOfLibrary(kSilent + "version.so"));
  EXPECT_THROW(HashOfLibrary("/no/such/library.so"), base::InputError);
  EXPECT_THROW(HashOfLibrary("/"), base::InputError);
}

}  // namespace
}  // namespace alula::scenarios
