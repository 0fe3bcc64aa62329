#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicles/flight_rig.h"

namespace alula::vehicles {
namespace {

using base::Milliseconds;
using base::Time;
using base::Vec3;
using Mode = stack::VehicleStatus::Mode;

/// What a stereo-inertial stack delivers: propagated to now, 5 ms late, 200 Hz, 1 cm and 0.5° of noise.
RigOptions StackLike(std::uint64_t seed) {
  RigOptions o;
  o.seed = seed;
  o.vision_period = Milliseconds(5);
  o.vision_delay = Milliseconds(5);
  o.vision_position_noise = 0.01;
  o.vision_attitude_noise = 0.5 * M_PI / 180;
  o.vision_velocity_noise = 0.05;
  return o;
}

/// Sends a fixed point every 20 ms.
auto Goto(FlightRig& rig, const Vec3& p, double yaw = 0) {
  return [&rig, p, yaw](Time t) {
    if (t.ns % 20'000'000 == 0) rig.Send(stack::PositionSetpoint{.p_OB = p, .yaw = yaw});
  };
}

/// A lying eight, 3 m/s and 4 m/s² at its peaks, started smoothly; t in s.
stack::PositionSetpoint Eight(double t) {
  constexpr double kWide = 2.2, kHigh = 0.75, kRate = 1.12, kRamp = 4;
  double phase = 0, rate = kRate, second = 0;
  if (t < kRamp) {
    phase = 0.5 * kRate * (t - kRamp / M_PI * std::sin(M_PI * t / kRamp));
    rate = 0.5 * kRate * (1 - std::cos(M_PI * t / kRamp));
    second = 0.5 * kRate * M_PI / kRamp * std::sin(M_PI * t / kRamp);
  } else {
    phase = kRate * (t - 0.5 * kRamp);
  }
  const Vec3 d1(kWide * std::cos(phase), 2 * kHigh * std::cos(2 * phase), 0);
  const Vec3 d2(-kWide * std::sin(phase), -4 * kHigh * std::sin(2 * phase), 0);
  stack::PositionSetpoint s;
  s.p_OB = {kWide * std::sin(phase), kHigh * std::sin(2 * phase), 1.5};
  s.v_OB = d1 * rate;
  s.a_OB = d2 * rate * rate + d1 * second;
  return s;
}

struct Tracking {
  double rms = 0, worst = 0;
};
Tracking FlyEight(FlightRig& rig, double seconds) {
  rig.TakeOff(1.5, 4);
  const double start = rig.now.Seconds();
  Tracking result;
  int n = 0;
  rig.RunFor(seconds, [&](Time now) {
    const double t = now.Seconds() - start;
    const stack::PositionSetpoint s = Eight(t);
    if (now.ns % 10'000'000 == 0) rig.Send(s);
    if (t < 1) return;
    const double e = (rig.body.state.X_WB.p - s.p_OB).norm();
    result.rms += e * e;
    result.worst = std::max(result.worst, e);
    ++n;
  });
  result.rms = std::sqrt(result.rms / n);
  return result;
}

TEST(Autopilot, TakesOffAndHovers) {
  FlightRig rig{RigOptions{}};
  rig.RunFor(0.3);
  EXPECT_FALSE(rig.output.status.ready_to_arm);
  rig.Send(stack::Arm{}, base::Seconds(3));  // too early: kept until the filter is ready
  rig.RunFor(0.1);
  EXPECT_FALSE(rig.output.status.armed);
  rig.RunFor(1.0);
  EXPECT_EQ(rig.output.status.mode, Mode::kReady);
  EXPECT_TRUE(rig.output.status.landed);
  rig.RunFor(4, Goto(rig, {0, 0, 1.2}));
  EXPECT_EQ(rig.output.status.mode, Mode::kFollowing);
  EXPECT_FALSE(rig.output.status.landed);
  EXPECT_LT((rig.body.state.X_WB.p - Vec3(0, 0, 1.2)).norm(), 0.02);
  EXPECT_LT(rig.body.state.v_WB.norm(), 0.03);
}

TEST(Autopilot, StepOfAMetreSettlesWithLittleOvershoot) {
  FlightRig rig{RigOptions{}};
  rig.TakeOff(1.5, 4);
  double furthest = 0, lowest = 9;
  rig.RunFor(3, [&](Time t) {
    Goto(rig, {1, 0, 1.5})(t);
    furthest = std::max(furthest, rig.body.state.X_WB.p.x());
    lowest = std::min(lowest, rig.body.state.X_WB.p.z());
  });
  EXPECT_LT(furthest, 1.06);
  EXPECT_GT(lowest, 1.43);
  EXPECT_NEAR(rig.body.state.X_WB.p.x(), 1, 0.04);
  rig.RunFor(3, Goto(rig, {1, 0, 1.5}, 1.5));
  EXPECT_NEAR(base::Yaw(rig.body.state.X_WB.q), 1.5, 0.03);
}

TEST(Autopilot, TracksAFigureEightWithinAFewCentimetres) {
  FlightRig rig{RigOptions{}};
  const Tracking t = FlyEight(rig, 16);
  EXPECT_LT(t.rms, 0.02);
  EXPECT_LT(t.worst, 0.05);
}

TEST(Autopilot, TracksOnNoisyStackEstimates) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    FlightRig rig(StackLike(seed));
    const Tracking t = FlyEight(rig, 12);
    EXPECT_LT(t.rms, 0.03);
    EXPECT_LT(t.worst, 0.06);
  }
}

TEST(Autopilot, TracksOnPositionsAloneAsFromMotionCapture) {
  RigOptions o;
  o.vision_velocity = false;
  o.vision_position_noise = 0.005;
  o.vision_attitude_noise = 0.005;
  FlightRig rig(o);
  EXPECT_LT(FlyEight(rig, 12).worst, 0.06);
}

TEST(Autopilot, FliesHeavyInGustyWind) {
  for (const double mass : {0.7125, 0.7875}) {
    RigOptions o = StackLike(7);
    o.mass = mass;
    o.wind = {2.1, 2.1, 0};  // 3 m/s
    o.gust = 1.0;
    FlightRig rig(o);
    const Tracking t = FlyEight(rig, 16);
    EXPECT_LT(t.rms, 0.10);
    EXPECT_LT(t.worst, 0.30);
  }
}

TEST(Autopilot, SilenceIsHeldThenLandsAndDisarms) {
  FlightRig rig(StackLike(2));
  rig.TakeOff(1.5, 4);
  rig.RunFor(1, [&](Time t) {
    if (t.ns % 20'000'000 == 0) rig.Send(stack::VelocitySetpoint{.v_OB = {1.5, 0, 0}});
  });
  EXPECT_NEAR(rig.body.state.v_WB.x(), 1.5, 0.15);
  rig.RunFor(2);
  EXPECT_EQ(rig.output.status.mode, Mode::kHolding);
  EXPECT_LT(rig.body.state.v_WB.norm(), 0.1);
  const Vec3 held = rig.body.state.X_WB.p;
  rig.RunFor(1.5);
  EXPECT_EQ(rig.output.status.mode, Mode::kLanding);
  double fastest = 0;
  rig.RunFor(7, [&](Time) { fastest = std::min(fastest, rig.body.state.v_WB.z()); });
  EXPECT_EQ(rig.output.status.mode, Mode::kDisarmed);
  EXPECT_TRUE(rig.output.status.landed);
  EXPECT_GT(fastest, -0.95);
  EXPECT_LT((rig.body.state.X_WB.p - held).head<2>().norm(), 0.1);
  EXPECT_NEAR(rig.body.state.X_WB.p.z(), rig.vehicle->body().standing_height, 0.005);
  EXPECT_EQ(rig.output.actuators.motors, std::vector<double>(4, 0.0));
}

TEST(Autopilot, AStackThatSpeaksAgainIsFollowedAgain) {
  FlightRig rig{RigOptions{}};
  rig.TakeOff(1.5, 4);
  rig.RunFor(2);
  EXPECT_EQ(rig.output.status.mode, Mode::kHolding);
  rig.RunFor(3, Goto(rig, {0.5, 0, 1.2}));
  EXPECT_EQ(rig.output.status.mode, Mode::kFollowing);
  EXPECT_LT((rig.body.state.X_WB.p - Vec3(0.5, 0, 1.2)).norm(), 0.05);
}

TEST(Autopilot, LandCommandLandsWhereItIs) {
  FlightRig rig(StackLike(3));
  rig.TakeOff(1.2, 4);
  rig.Send(stack::Land{});
  rig.RunFor(8);
  EXPECT_EQ(rig.output.status.mode, Mode::kDisarmed);
  EXPECT_LT(rig.body.state.X_WB.p.head<2>().norm(), 0.1);
}

TEST(Autopilot, HoldCommandStaysAsLongAsItIsValid) {
  FlightRig rig{RigOptions{}};
  rig.TakeOff(1.2, 4);
  rig.Send(stack::Hold{}, base::Seconds(8));
  rig.RunFor(7);
  EXPECT_EQ(rig.output.status.mode, Mode::kHolding);
  EXPECT_LT((rig.body.state.X_WB.p - Vec3(0, 0, 1.2)).norm(), 0.05);
}

TEST(Autopilot, WithoutEstimatesItComesDownUpright) {
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    FlightRig rig(StackLike(seed));
    rig.TakeOff(1.5, 4);
    rig.RunFor(2, [&](Time t) {
      if (t.ns % 20'000'000 == 0) rig.Send(stack::VelocitySetpoint{.v_OB = {1.0, 0, 0}});
    });
    rig.vision = false;
    double tilt = 0, fastest = 0;
    rig.RunFor(14, [&](Time t) {
      if (t.ns % 20'000'000 == 0) rig.Send(stack::VelocitySetpoint{.v_OB = {1.0, 0, 0}});  // the stack talks on
      const double up = (rig.body.state.X_WB.q * Vec3::UnitZ()).z();
      tilt = std::max(tilt, std::acos(std::min(1.0, up)));
      fastest = std::max(fastest, rig.body.state.v_WB.norm());
    });
    EXPECT_EQ(rig.output.status.mode, Mode::kDisarmed) << seed;
    EXPECT_LT(tilt, 0.6);
    EXPECT_LT(fastest, 1.6);
  }
}

TEST(Autopilot, ResetOfTheOdometryFrameDoesNotThrowItOffItsHold) {
  FlightRig rig(StackLike(5));
  rig.TakeOff(1.5, 4);
  rig.Send(stack::Hold{}, base::Seconds(20));
  rig.RunFor(2);
  const Vec3 before = rig.body.state.X_WB.p;
  rig.X_OW = {base::FromYaw(0.8), {4, -2, 1}};
  rig.reset_counter = 1;
  double worst = 0;
  rig.RunFor(4, [&](Time) { worst = std::max(worst, (rig.body.state.X_WB.p - before).norm()); });
  EXPECT_LT(worst, 0.12);
  EXPECT_NEAR((rig.autopilot->OwnEstimate()->X_WB.p - rig.X_OW * rig.body.state.X_WB.p).norm(), 0, 0.05);
}

TEST(Autopilot, DisarmsWhenNothingFollowsArmingAndRefusesToDisarmInTheAir) {
  FlightRig rig{RigOptions{}};
  rig.RunFor(1.2);
  rig.Send(stack::Arm{}, base::Seconds(1));
  rig.RunFor(1);
  EXPECT_TRUE(rig.output.status.armed);
  rig.RunFor(10);
  EXPECT_FALSE(rig.output.status.armed);
  FlightRig flying{RigOptions{}};
  flying.TakeOff(1.2, 3);
  flying.Send(stack::Disarm{});
  flying.RunFor(0.5, Goto(flying, {0, 0, 1.2}));
  EXPECT_TRUE(flying.output.status.armed);
  EXPECT_GT(flying.body.state.X_WB.p.z(), 1.1);
}

TEST(Autopilot, RunsAreEqualToTheBit) {
  const auto fly = [] {
    FlightRig rig(StackLike(9));
    rig.TakeOff(1.2, 3);
    return rig.body.state.X_WB.p;
  };
  EXPECT_EQ(fly(), fly());
}

}  // namespace
}  // namespace alula::vehicles
