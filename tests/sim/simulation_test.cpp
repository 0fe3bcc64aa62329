#include "sim/simulation.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "base/error.h"
#include "sim/run_digest.h"
#include "tests/sim/test_world.h"

namespace alula::sim {
namespace {

using base::Milliseconds;
using base::Time;

/// Pushes up with its weight, come what may.
class HoldingVehicle : public vehicles::VehicleModel {
 public:
  HoldingVehicle() : body_(testing::PlateOnLegs()) {}
  const vehicles::VehicleBody& body() const override { return body_; }
  vehicles::Wrench Step(const vehicles::BodyState&, const vehicles::ActuatorCommand&, const base::Vec3&,
                        base::Duration) override {
    return {.force_W = {0, 0, lift}, .torque_W = base::Vec3::Zero()};
  }
  stack::BatterySample Battery() const override { return {16.0, 1.0}; }
  std::vector<vehicles::TelemetryValue> Telemetry() const override { return {}; }
  double lift = base::kGravity + 0.1;

 private:
  vehicles::VehicleBody body_;
};

/// Notes when what arrives.
struct Notes {
  std::vector<std::pair<Time, Time>> commands;  // received, issued
  std::vector<Time> estimates;
  int steps = 0;
};
class NotingAutopilot : public vehicles::Autopilot {
 public:
  explicit NotingAutopilot(Notes& notes) : notes_(notes) {}
  void Receive(Time now, const stack::Command& command) override { notes_.commands.emplace_back(now, command.issued); }
  void Receive(Time now, const stack::Estimate&) override { notes_.estimates.push_back(now); }
  vehicles::AutopilotOutput Step(Time, const vehicles::AutopilotSensors&) override {
    ++notes_.steps;
    return {};
  }

 private:
  Notes& notes_;
};

/// Answers as a lambda says.
class LambdaStack : public stack::NavigationStack {
 public:
  using Answer = std::function<stack::StackOutput(Time, std::span<const stack::Measurement>)>;
  explicit LambdaStack(Answer answer) : answer_(std::move(answer)) {}
  stack::StackOutput Step(Time now, std::span<const stack::Measurement> measurements) override {
    return answer_(now, measurements);
  }

 private:
  Answer answer_;
};

SimulationParts Parts(LambdaStack::Answer answer) {
  SimulationParts parts;
  parts.world = std::make_shared<const worlds::World>(testing::GroundAndCrate());
  parts.vehicle = std::make_unique<HoldingVehicle>();
  parts.stack = std::make_unique<LambdaStack>(std::move(answer));
  parts.sensors.position_reference = PositionReferenceConfig{};
  return parts;
}

TEST(Simulation, HandsMeasurementsOverWhenAvailableAndInOrder) {
  std::vector<stack::Measurement> seen;
  Simulation simulation(Parts([&](Time now, std::span<const stack::Measurement> measurements) {
    for (const stack::Measurement& m : measurements) {
      EXPECT_LE(m.available, now);
      EXPECT_GT(m.available, now + Milliseconds(-1));
      EXPECT_TRUE(seen.empty() || ArrivesBefore(seen.back(), m));
      seen.push_back(m);
    }
    return stack::StackOutput{};
  }));
  for (int i = 0; i < 1000; ++i) simulation.Step();
  int imu = 0, fixes = 0;
  for (const stack::Measurement& m : seen) {
    if (std::holds_alternative<stack::ImuSample>(m.data)) ++imu;
    if (std::holds_alternative<stack::PositionFix>(m.data)) {
      ++fixes;
      EXPECT_EQ(m.available - m.captured, Milliseconds(20));
    }
  }
  EXPECT_EQ(imu, 199);   // 200 Hz from 0 on, the first one describes an instant before the run
  EXPECT_EQ(fixes, 49);  // 50 Hz, the last one still under way
}

TEST(Simulation, LinkDelaysCommandsAndEstimates) {
  Notes notes;
  SimulationParts parts = Parts([](Time now, std::span<const stack::Measurement>) {
    stack::StackOutput output;
    if (now.ns % 10'000'000 == 0) {
      output.commands.push_back({stack::Hold{}, now, now + Milliseconds(100)});
      output.estimate = stack::Estimate{.stamp = now, .X_OB = {}, .X_MO = {}};
    }
    return output;
  });
  parts.autopilot = std::make_unique<NotingAutopilot>(notes);
  Simulation simulation(std::move(parts));
  for (int i = 0; i < 96; ++i) simulation.Step();
  EXPECT_EQ(notes.steps, 96);
  ASSERT_EQ(notes.commands.size(), 10U);
  EXPECT_EQ(notes.estimates.size(), 10U);
  for (const auto& [received, issued] : notes.commands) EXPECT_EQ(received - issued, Milliseconds(5));
}

TEST(Simulation, StackThatThrowsIsAFault) {
  Simulation simulation(Parts([](Time now, std::span<const stack::Measurement>) -> stack::StackOutput {
    if (now >= Time{50'000'000}) throw std::runtime_error("map is empty");
    return {};
  }));
  for (int i = 0; i < 50; ++i) simulation.Step();
  try {
    simulation.Step();
    FAIL();
  } catch (const base::FaultError& e) {
    EXPECT_EQ(e.reason(), "stack_exception");
    EXPECT_STREQ(e.what(), "map is empty");
  }
}

TEST(Simulation, StackThatReturnsNanIsAFault) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto reason = [](stack::StackOutput output) {
    Simulation simulation(Parts([&](Time, std::span<const stack::Measurement>) { return output; }));
    try {
      simulation.Step();
      return std::string("none");
    } catch (const base::FaultError& e) {
      return e.reason() + ": " + e.what();
    }
  };
  stack::StackOutput output;
  output.estimate.emplace();
  output.estimate->v_OB.x() = nan;
  EXPECT_EQ(reason(output), "stack_nan: the stack's estimate.v_OB is not finite");
  output.estimate.reset();
  output.commands.push_back({stack::PositionSetpoint{.yaw = nan}, {}, {}});
  EXPECT_EQ(reason(output), "stack_nan: the stack's position set-point's yaw is not finite");
  output.commands.clear();
  EXPECT_EQ(reason(output), "none");
}

TEST(Simulation, NonFiniteForcesAreANumericalFault) {
  SimulationParts parts = Parts([](Time, std::span<const stack::Measurement>) { return stack::StackOutput{}; });
  auto vehicle = std::make_unique<HoldingVehicle>();
  vehicle->lift = std::numeric_limits<double>::infinity();
  parts.vehicle = std::move(vehicle);
  Simulation simulation(std::move(parts));
  try {
    for (int i = 0; i < 5; ++i) simulation.Step();
    FAIL();
  } catch (const base::FaultError& e) {
    EXPECT_EQ(e.reason(), "numerical");
  }
}

/// Hashes, and ends the run after a while.
class Watcher : public Observer {
 public:
  std::optional<std::string> Observe(const StepView& step) override {
    digest.Add(step);
    EXPECT_EQ(step.truth.end - step.truth.begin, Milliseconds(1));
    if (step.time >= Time{200'000'000}) return "enough";
    return std::nullopt;
  }
  RunDigest digest;
};

TEST(Simulation, IsAFunctionOfItsPartsAndSeed) {
  const auto run = [](std::uint64_t seed) {
    SimulationParts parts = Parts([](Time, std::span<const stack::Measurement>) { return stack::StackOutput{}; });
    Watcher watcher;
    parts.observers = {&watcher};
    parts.seed = seed;
    Simulation simulation(std::move(parts));
    std::optional<std::string> reason;
    while (!reason) reason = simulation.Step();
    EXPECT_EQ(*reason, "enough");
    return watcher.digest.Hex();
  };
  EXPECT_EQ(run(1), run(1));
  EXPECT_NE(run(1), run(2));
}

TEST(TruthWindow, InterpolatesExactlyWhatIsSmooth) {
  TruthWindow window{{0}, {1'000'000}, {}, {}};
  const auto state = [](double t) {
    vehicles::BodyState s;
    s.X_WB = {base::Exp({0.3 * t, 0, 0}), {t * t * t, 2 * t, 1.0}};
    s.v_WB = {3 * t * t, 2, 0};
    s.w_B = {0.3, 0, 0};
    return s;
  };
  window.at_begin = state(0.0);
  window.at_end = state(1e-3);
  const vehicles::BodyState middle = window.At({300'000});
  EXPECT_LT((middle.X_WB.p - state(3e-4).X_WB.p).norm(), 1e-15);
  EXPECT_LT(base::Log(middle.X_WB.q.conjugate() * state(3e-4).X_WB.q).norm(), 1e-12);
}

}  // namespace
}  // namespace alula::sim
