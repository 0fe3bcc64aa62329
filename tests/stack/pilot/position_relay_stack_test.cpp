#include "stack/pilot/position_relay_stack.h"

#include <gtest/gtest.h>

#include <optional>

#include "base/error.h"

namespace alula::stack::pilot {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;

Calibration WithReference() {
  Calibration calibration;
  calibration.position_reference = PositionReferenceCalibration{SensorId{5}, "vehicle0/position"};
  calibration.status_sensor = SensorId{6};
  return calibration;
}

/// A point that goes where the set-point was 0.1 s ago, and lands when told.
struct Toy {
  Vec3 p = Vec3(1, 2, 0.1);
  VehicleStatus status;
  std::vector<std::pair<Time, PositionSetpoint>> setpoints;

  void Obey(const Command& command) {
    if (std::holds_alternative<Arm>(command.what)) status.armed = true;
    if (std::holds_alternative<Land>(command.what)) status.mode = VehicleStatus::Mode::kLanding;
    if (const auto* setpoint = std::get_if<PositionSetpoint>(&command.what)) {
      setpoints.emplace_back(command.issued, *setpoint);
    }
  }
  void Move(Time now) {
    if (status.mode == VehicleStatus::Mode::kLanding) {
      p.z() = std::max(0.1, p.z() - 0.001);
      if (p.z() <= 0.1) status.armed = false;
      return;
    }
    for (const auto& [time, setpoint] : setpoints) {
      if (time + Milliseconds(100) <= now) p = setpoint.p_OB;
    }
    if (setpoints.size() > 20) setpoints.erase(setpoints.begin(), setpoints.end() - 20);
  }
};

TEST(PositionRelayStack, FliesItsWaypointsAndLands) {
  Mission mission;
  mission.waypoints = {{4, 2, 1.5}, {4, 5, 2.0}, {1, 2, 1.2}};
  const auto stack = MakePositionRelayStack(WithReference(), mission, {});
  Toy toy;
  std::size_t visited = 0;
  std::vector<StackState> states;
  double fastest = 0.0, hardest = 0.0;
  Time now;
  for (; now < Time{60'000'000'000}; now += Milliseconds(1)) {
    std::vector<Measurement> measurements;
    toy.status.ready_to_arm = now > Time{1'000'000'000};
    if (now.ns % 20'000'000 == 0) {
      measurements.push_back({SensorId{5}, 0, now, now, PositionFix{{base::Quat::Identity(), toy.p}, 0.01, 0.01}});
      // Satellites, which the stack leaves alone.
      measurements.push_back({SensorId{7}, 0, now, now, PositionFix{{base::Quat::Identity(), {9, 9, 9}}, 3.0, 1e3}});
      measurements.push_back({SensorId{6}, 0, now, now, toy.status});
    }
    const StackOutput output = stack->Step(now, measurements);
    for (const Command& command : output.commands) {
      EXPECT_EQ((command.expires - command.issued).ns, 500'000'000);
      toy.Obey(command);
      if (const auto* s = std::get_if<PositionSetpoint>(&command.what)) {
        fastest = std::max(fastest, s->v_OB.norm());
        hardest = std::max(hardest, s->a_OB.norm());
      }
    }
    if (output.estimate) {
      EXPECT_LT((output.estimate->X_OB.p - toy.p).norm(), 1e-9);
      EXPECT_GT(output.estimate->velocity_covariance(0, 0), 0.1);
    }
    toy.Move(now);
    if (visited < mission.waypoints.size() && (toy.p - mission.waypoints[visited]).norm() < 0.02) ++visited;
    if (states.empty() || states.back() != output.state) states.push_back(output.state);
    if (output.state == StackState::kDone) break;
  }
  EXPECT_EQ(visited, 3U);
  EXPECT_EQ(states, (std::vector<StackState>{StackState::kInitialising, StackState::kReady, StackState::kFlying,
                                             StackState::kDone}));
  EXPECT_LT(now.Seconds(), 40.0);
  EXPECT_LE(fastest, 1.0 + 1e-9);
  EXPECT_LE(hardest, 1.5 * 1.01);
}

TEST(PositionRelayStack, LandsWhenPositionsStop) {
  Mission mission;
  mission.waypoints = {{50, 2, 1.5}};
  const auto stack = MakePositionRelayStack(WithReference(), mission, {});
  Toy toy;
  toy.status.ready_to_arm = true;
  bool landing = false;
  std::string event;
  for (Time now; now < Time{10'000'000'000}; now += Milliseconds(10)) {
    std::vector<Measurement> measurements;
    measurements.push_back({SensorId{6}, 0, now, now, toy.status});
    if (now < Time{5'000'000'000}) {
      measurements.push_back({SensorId{5}, 0, now, now, PositionFix{{base::Quat::Identity(), toy.p}, 0.01, 0.01}});
    }
    const StackOutput output = stack->Step(now, measurements);
    for (const StackEvent& e : output.events) event = e.kind;
    for (const Command& command : output.commands) {
      toy.Obey(command);
      landing = landing || std::holds_alternative<Land>(command.what);
    }
    toy.Move(now);
  }
  EXPECT_TRUE(landing);
}

TEST(PositionRelayStack, NeedsAPositionReference) {
  EXPECT_THROW(MakePositionRelayStack({}, {}, {}), base::InputError);
}

}  // namespace
}  // namespace alula::stack::pilot
