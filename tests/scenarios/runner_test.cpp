// Faults of a stack, through the library as one who brings a stack of their own would use it.
#include "scenarios/runner.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "scenarios/verdict.h"
#include "tests/scenarios/temporary_folder.h"

namespace alula::scenarios {
namespace {

using testing::ReadText;
using testing::TemporaryFolder;

/// Flies nothing and misbehaves at a given time.
class BadStack : public stack::NavigationStack {
 public:
  enum class Habit { kThrow, kThrowOddly, kNan };
  explicit BadStack(Habit habit) : habit_(habit) {}
  stack::StackOutput Step(base::Time now, std::span<const stack::Measurement>) override {
    stack::StackOutput output;
    if (now == base::Time{}) output.events.push_back({now, "begin", "all is well"});
    if (now < base::Time{} + base::Milliseconds(300)) return output;
    if (habit_ == Habit::kThrow) throw std::out_of_range("keyframe 17");
    if (habit_ == Habit::kThrowOddly) throw 42;
    output.estimate.emplace();
    output.estimate->X_OB.p.z() = std::numeric_limits<double>::quiet_NaN();
    return output;
  }

 private:
  Habit habit_;
};

Verdict RunBadly(BadStack::Habit habit, const std::filesystem::path& out) {
  RunOptions options;
  options.out = out;
  options.stack = [habit](const stack::Calibration&, const stack::Mission&, std::uint64_t, int) {
    return std::make_unique<BadStack>(habit);
  };
  return RunScenario(LoadScenario(FindScenario("hover"), {}, 1), options);
}

TEST(Runner, StackThatThrowsIsAFaultWhoseFolderHoldsWhatLedToIt) {
  const TemporaryFolder folder("runner_throw");
  const Verdict verdict = RunBadly(BadStack::Habit::kThrow, folder.path());
  EXPECT_EQ(verdict.outcome, Outcome::kFault);
  EXPECT_EQ(ExitCode(verdict.outcome), 3);
  EXPECT_EQ(verdict.reason, "stack_exception");
  EXPECT_EQ(verdict.message, "keyframe 17");
  const auto json = nlohmann::json::parse(ReadText(folder.path() / "verdict.json"));
  EXPECT_EQ(json["outcome"], "fault");
  EXPECT_EQ(json["reason"], "stack_exception");
  const std::string events = ReadText(folder.path() / "events.jsonl");
  EXPECT_NE(events.find("all is well"), std::string::npos);
  EXPECT_NE(events.find("stack_exception: keyframe 17"), std::string::npos);
  const std::string telemetry = ReadText(folder.path() / "telemetry.csv");
  EXPECT_NE(telemetry.find("\n0.300000,"), std::string::npos);  // up to the step that threw
}

TEST(Runner, AnythingThrownIsCaught) {
  const TemporaryFolder folder("runner_odd");
  EXPECT_EQ(RunBadly(BadStack::Habit::kThrowOddly, folder.path()).reason, "stack_exception");
}

TEST(Runner, StackThatReturnsNanIsAFault) {
  const TemporaryFolder folder("runner_nan");
  const Verdict verdict = RunBadly(BadStack::Habit::kNan, folder.path());
  EXPECT_EQ(verdict.outcome, Outcome::kFault);
  EXPECT_EQ(verdict.reason, "stack_nan");
  EXPECT_EQ(verdict.message, "the stack's estimate.X_OB is not finite");
}

TEST(Runner, MakerThatThrowsIsAFaultAndBadInputIsBadInput) {
  const Scenario scenario = LoadScenario(FindScenario("hover"), {}, 1);
  RunOptions options;
  options.stack = [](const stack::Calibration&, const stack::Mission&, std::uint64_t,
                     int) -> std::unique_ptr<stack::NavigationStack> { throw std::runtime_error("no vocabulary"); };
  EXPECT_EQ(RunScenario(scenario, options).reason, "stack_exception");
  options.stack = [](const stack::Calibration&, const stack::Mission&, std::uint64_t,
                     int) -> std::unique_ptr<stack::NavigationStack> { throw base::InputError("needs a camera"); };
  EXPECT_THROW(RunScenario(scenario, options), base::InputError);
}

TEST(Runner, SpectatorsSeeTheRunAndChangeNothing) {
  class Counter : public Spectator {
   public:
    explicit Counter(int& steps) : steps_(steps) {}
    std::optional<std::string> Observe(const sim::StepView&) override {
      ++steps_;
      return std::nullopt;
    }
    void Finish() override { steps_ = -steps_; }

   private:
    int& steps_;
  };
  const Scenario scenario = LoadScenario(FindScenario("hover"), {{"criteria", "[{type: time_limit, limit: 2 s}]"}}, 1);
  int steps = 0;
  RunOptions options;
  const std::string digest = RunScenario(scenario, options).digest;
  options.spectators.push_back([&](const Stage&) { return std::make_unique<Counter>(steps); });
  EXPECT_EQ(RunScenario(scenario, options).digest, digest);
  EXPECT_EQ(steps, -2000);
}

TEST(Scenario, ResolvedScenarioReadsBackToTheSameRun) {
  const TemporaryFolder folder("resolved");
  RunOptions options;
  options.out = folder.path();
  const std::vector<base::Override> shorter{{"criteria", "[{type: time_limit, limit: 3 s}]"}};
  const Verdict first = RunScenario(LoadScenario(FindScenario("hover"), shorter, 5), options);
  const Verdict again = RunScenario(LoadScenario(folder.path() / "scenario.yaml", {}, std::nullopt), {});
  EXPECT_EQ(again.seed, 5U);
  EXPECT_EQ(again.digest, first.digest);
}

TEST(Scenario, EveryScenarioOfTheCatalogCanBeBuilt) {
  for (const std::filesystem::path& file : ListScenarios()) {
    EXPECT_NO_THROW(TryToBuild(LoadScenario(file, {}, std::nullopt))) << file;
  }
}

}  // namespace
}  // namespace alula::scenarios
