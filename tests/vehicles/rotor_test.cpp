#include "vehicles/rotor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "vehicles/aerodynamics.h"
#include "vehicles/battery.h"

namespace alula::vehicles {
namespace {

using base::Milliseconds;
using base::Vec3;

constexpr double kDensity = 1.225;
constexpr double kExact = 1e-12;  // relative: a few hundred roundings

RotorLoad Settle(Rotor& rotor, const RotorConfig& c, double command, const Vec3& v = Vec3::Zero(),
                 const Vec3& w = Vec3::Zero()) {
  RotorLoad load;
  for (int i = 0; i < 2000; ++i) load = rotor.Step(command, c.nominal_voltage, v, w, Milliseconds(1));
  return load;
}

TEST(Rotor, StepResponseIsFirstOrderAfterTheDelay) {
  const RotorConfig c;
  Rotor rotor(c, kDensity, 1);
  for (int i = 0; i < 10; ++i) rotor.Step(0, c.nominal_voltage, Vec3::Zero(), Vec3::Zero(), Milliseconds(1));
  for (int i = 1; i <= 100; ++i) {
    rotor.Step(0.6, c.nominal_voltage, Vec3::Zero(), Vec3::Zero(), Milliseconds(1));
    const double t = std::max(0.0, i * 1e-3 - c.esc_delay.Seconds());
    EXPECT_NEAR(rotor.speed(), 0.6 * c.maximum_speed * -std::expm1(-t / c.time_constant), c.maximum_speed * kExact);
  }
}

TEST(Rotor, StepLengthDoesNotMatterForAConstantCommand) {
  const RotorConfig c;
  Rotor fine(c, kDensity, 1), coarse(c, kDensity, 1);
  for (int i = 0; i < 40; ++i) fine.Step(0.5, c.nominal_voltage, Vec3::Zero(), Vec3::Zero(), base::Microseconds(500));
  for (int i = 0; i < 20; ++i) coarse.Step(0.5, c.nominal_voltage, Vec3::Zero(), Vec3::Zero(), Milliseconds(1));
  EXPECT_NEAR(fine.speed(), coarse.speed(), c.maximum_speed * kExact);
}

TEST(Rotor, StaticThrustAndTorqueFollowTheSquareOfSpeed) {
  const RotorConfig c;
  for (const double command : {0.2, 0.5, 1.0}) {
    Rotor rotor(c, kDensity, 1);
    const RotorLoad load = Settle(rotor, c, command);
    const double n = command * c.maximum_speed / (2 * M_PI);  // rev/s
    EXPECT_NEAR(load.force_B.z(), c.thrust_coefficient * kDensity * n * n * std::pow(c.diameter, 4), 1e-9);
    EXPECT_NEAR(load.torque_B.z(), -c.torque_coefficient * kDensity * n * n * std::pow(c.diameter, 5), 1e-10);
    EXPECT_NEAR(load.shaft_power, -load.torque_B.z() * rotor.speed(), 1e-8);
  }
}

TEST(Rotor, AFailingMotorGivesItsShareOfThrustAndTorqueAtEveryCommand) {
  const RotorConfig c;
  for (const double command : {0.3, 1.0}) {
    for (const double share : {0.0, 0.25, 0.7, 1.0}) {
      Rotor good(c, kDensity, 1), bad(c, kDensity, 1);
      bad.Impair(share);
      const RotorLoad whole = Settle(good, c, command), left = Settle(bad, c, command);
      EXPECT_NEAR(left.force_B.z(), share * whole.force_B.z(), whole.force_B.z() * kExact);
      EXPECT_NEAR(left.torque_B.z(), share * whole.torque_B.z(), std::abs(whole.torque_B.z()) * kExact);
    }
  }
  Rotor rotor(c, kDensity, 1);
  Settle(rotor, c, 0.5);
  rotor.Impair(0.0);  // spins down with the motor's lag, not at once
  rotor.Step(0.5, c.nominal_voltage, Vec3::Zero(), Vec3::Zero(), Milliseconds(1));
  EXPECT_NEAR(rotor.speed(), 0.5 * c.maximum_speed * std::exp(-1e-3 / c.time_constant), c.maximum_speed * kExact);
}

TEST(Rotor, ThrustVanishesAtTheZeroThrustAdvanceRatioAndIsCappedInDescent) {
  const RotorConfig c;
  Rotor rotor(c, kDensity, 1);
  const double still = Settle(rotor, c, 0.5).force_B.z();
  const double n = rotor.speed() / (2 * M_PI);
  const double vanish = c.zero_thrust_advance * n * c.diameter;
  EXPECT_NEAR(Settle(rotor, c, 0.5, {0, 0, vanish}).force_B.z(), 0.0, 1e-9);
  EXPECT_NEAR(Settle(rotor, c, 0.5, {0, 0, 0.25 * vanish}).force_B.z(), 0.75 * still, 1e-9);
  EXPECT_NEAR(Settle(rotor, c, 0.5, {0, 0, -0.1 * vanish}).force_B.z(), 1.1 * still, 1e-9);
  EXPECT_NEAR(Settle(rotor, c, 0.5, {0, 0, -vanish}).force_B.z(), 1.4 * still, 1e-9);
}

TEST(Rotor, DragInItsPlaneOpposesTheMotionAndGrowsWithSpeed) {
  const RotorConfig c;
  Rotor rotor(c, kDensity, 1);
  const RotorLoad load = Settle(rotor, c, 0.5, {2, -1, 0});
  const double radius = 0.5 * c.diameter, area = M_PI * radius * radius;
  const double k = c.in_plane_drag * kDensity * area * radius * rotor.speed();
  EXPECT_NEAR(load.force_B.x(), -2 * k, 1e-9);
  EXPECT_NEAR(load.force_B.y(), k, 1e-9);
}

TEST(Rotor, ReactsWithItsInertiaAndAsAGyroscope) {
  RotorConfig c;
  c.torque_coefficient = 0;  // inertia alone
  Rotor rotor(c, kDensity, -1);
  double impulse = 0;
  for (int i = 0; i < 500; ++i) {
    impulse += 1e-3 * rotor.Step(0.7, c.nominal_voltage, Vec3::Zero(), Vec3::Zero(), Milliseconds(1)).torque_B.z();
  }
  EXPECT_NEAR(impulse, c.inertia * rotor.speed(), 1e-12);  // spin −1: the body is turned the other way, +z
  const Vec3 w(1.5, -0.5, 0.3);
  const RotorLoad load = rotor.Step(0.7, c.nominal_voltage, Vec3::Zero(), w, Milliseconds(1));
  const Vec3 momentum(0, 0, -c.inertia * rotor.speed());
  EXPECT_NEAR((load.torque_B + w.cross(momentum)).head<2>().norm(), 0, 1e-12);
}

TEST(Rotor, SpeedScalesWithVoltageAndSaturates) {
  const RotorConfig c;
  Rotor rotor(c, kDensity, 1);
  for (int i = 0; i < 2000; ++i) {
    rotor.Step(1.7, 0.8 * c.nominal_voltage, Vec3::Zero(), Vec3::Zero(), Milliseconds(1));
  }
  EXPECT_NEAR(rotor.speed(), 0.8 * c.maximum_speed, 1e-6);
}

TEST(Battery, SagSolvesTheCircuit) {
  const BatteryConfig c;
  Battery battery(c);
  for (const double shaft : {0.0, 100.0, 500.0, 1000.0}) {
    battery.Step(shaft, Milliseconds(1));
    const double open = c.cells * CellVoltage(battery.state_of_charge());
    const double power = shaft / c.drive_efficiency + c.avionics_power;
    EXPECT_NEAR(battery.voltage() * battery.current(), power, 1e-9);
    EXPECT_NEAR(battery.voltage() + c.internal_resistance * battery.current(), open, 1e-4);  // charge moved by one step
  }
}

TEST(Battery, ACollapsedPackSolvesTheCircuitOfWhatIsLeft) {
  const BatteryConfig c;
  Battery battery(c);
  battery.Impair(4.0, 0.75);
  battery.Step(120, Milliseconds(1));
  const double open = 0.75 * c.cells * CellVoltage(battery.state_of_charge());
  EXPECT_NEAR(battery.voltage() * battery.current(), 120 / c.drive_efficiency + c.avionics_power, 1e-9);
  EXPECT_NEAR(battery.voltage() + 4 * c.internal_resistance * battery.current(), open, 1e-4);  // charge moved by a step
  battery.Impair(1.0, 1.0);
  battery.Step(120, Milliseconds(1));
  EXPECT_NEAR(battery.voltage() + c.internal_resistance * battery.current(), c.cells * CellVoltage(c.initial_charge),
              1e-3);  // mended
}

TEST(Battery, DrainsAsTheCurrentSays) {
  const BatteryConfig c;
  Battery battery(c);
  double charge = 0;
  for (int i = 0; i < 60'000; ++i) {
    battery.Step(120, Milliseconds(1));
    charge += battery.current() * 1e-3;
  }
  EXPECT_NEAR(battery.state_of_charge(), c.initial_charge - charge / c.capacity, 1e-9);
  EXPECT_LT(battery.voltage(), c.cells * CellVoltage(c.initial_charge));
}

TEST(Battery, CellVoltageRisesWithChargeAndMeetsItsPoints) {
  EXPECT_DOUBLE_EQ(CellVoltage(1.0), 4.2);
  EXPECT_DOUBLE_EQ(CellVoltage(0.5), 3.85);
  EXPECT_DOUBLE_EQ(CellVoltage(0.0), 3.3);
  for (double s = 0.01; s <= 1.0; s += 0.01) EXPECT_GT(CellVoltage(s), CellVoltage(s - 0.01));
}

TEST(Battery, OverloadGivesHalfTheVoltage) {
  Battery battery{BatteryConfig{}};
  battery.Step(1e5, Milliseconds(1));
  EXPECT_NEAR(battery.voltage(), 0.5 * 4 * CellVoltage(0.9), 1e-9);
}

TEST(Aerodynamics, DragIsLinearPlusQuadratic) {
  const AerodynamicsConfig c;
  const Vec3 v(3, -2, 1);
  const Vec3 drag = BodyDrag(c, kDensity, v);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(drag[i], -(0.5 * kDensity * c.drag_area[i] * v.norm() + c.linear_drag) * v[i], 1e-12);
  }
}

}  // namespace
}  // namespace alula::vehicles
