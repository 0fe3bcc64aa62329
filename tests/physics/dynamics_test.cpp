// Vehicle physics against closed form, on the tests' own rigid body: no physics engine takes part.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/vehicles/flight_rig.h"

namespace alula::vehicles {
namespace {

using base::Milliseconds;
using base::Vec3;

constexpr double kStep = 1e-3;  // s

struct Free {
  explicit Free(const QuadrotorConfig& config) : vehicle(MakeQuadrotor(config, "vehicle0")), body(vehicle->body()) {
    body.ground = false;
    body.state.X_WB.p.z() = 1000;
  }
  void Run(int steps, double command, const Vec3& wind = Vec3::Zero()) {
    for (int i = 0; i < steps; ++i) {
      body.Step(vehicle->Step(body.state, {std::vector<double>(4, command)}, wind, Milliseconds(1)), kStep);
    }
  }
  std::unique_ptr<VehicleModel> vehicle;
  RigidBodyRig body;
};

TEST(Dynamics, FreeFallWithoutAirIsGravity) {
  QuadrotorConfig c;
  c.aerodynamics = {.drag_area = Vec3::Zero(), .linear_drag = 0};
  Free f(c);
  f.Run(2000, 0);
  EXPECT_NEAR(f.body.state.v_WB.z(), -base::kGravity * 2, 1e-10);
  // Semi-implicit Euler falls by g t (t + dt) / 2.
  EXPECT_NEAR(f.body.state.X_WB.p.z(), 1000 - 0.5 * base::kGravity * 2 * (2 + kStep), 1e-9);
}

TEST(Dynamics, TerminalVelocitySolvesTheDragEquation) {
  const QuadrotorConfig c;
  Free f(c);
  f.Run(40'000, 0);
  const double a = 0.5 * c.air_density * c.aerodynamics.drag_area.z(), b = c.aerodynamics.linear_drag;
  const double v = (-b + std::sqrt(b * b + 4 * a * c.mass * base::kGravity)) / (2 * a);
  EXPECT_NEAR(f.body.state.v_WB.z(), -v, 1e-6);
}

TEST(Dynamics, WindCarriesWhatFallsWithIt) {
  const QuadrotorConfig c;
  Free f(c);
  f.Run(60'000, 0, {3, 0, 0});
  EXPECT_NEAR(f.body.state.v_WB.x(), 3, 1e-3);
}

TEST(Dynamics, HoverThrustBalancesWeight) {
  QuadrotorConfig c;
  c.battery.internal_resistance = 0;  // the voltage is the open-circuit one
  c.battery.capacity = 1e12;          // and stays
  Free f(c);
  const double full = 4 * ThrustConstant(c.rotor, c.air_density) * std::pow(c.rotor.maximum_speed, 2);
  const double voltage = c.battery.cells * CellVoltage(c.battery.initial_charge);
  const double hover = std::sqrt(c.mass * base::kGravity / full) * c.rotor.nominal_voltage / voltage;
  f.Run(1000, hover);
  const double before = f.body.state.v_WB.z();
  EXPECT_LT(before, 0);  // it fell while the rotors spun up; their inflow then brakes it
  const Wrench w = f.vehicle->Step({}, {std::vector<double>(4, hover)}, Vec3::Zero(), Milliseconds(1));
  EXPECT_NEAR(w.force_W.z(), c.mass * base::kGravity, 1e-6 * c.mass * base::kGravity);  // after forty time constants
  EXPECT_LT(w.torque_W.norm(), 1e-9);
}

TEST(Dynamics, SpinUpConservesAngularMomentum) {
  QuadrotorConfig c;
  c.rotor.torque_coefficient = 0;  // no torque from the air: motors and body turn against each other
  c.rotor.in_plane_drag = 0;
  c.rotor.zero_thrust_advance = 1e9;  // nor damping by inflow while the body turns
  Free f(c);
  const QuadrotorLayout layout = LayOutQuadrotor(c);
  for (int i = 0; i < 500; ++i) {  // the two counter-clockwise rotors only
    f.body.Step(f.vehicle->Step(f.body.state, {{0.7, 0.7, 0, 0}}, Vec3::Zero(), Milliseconds(1)), kStep);
  }
  EXPECT_LT(f.body.state.w_B.z(), -1);  // the body turns clockwise
  Vec3 momentum_B = layout.body.inertia * f.body.state.w_B;
  double rotors = 0;
  for (const TelemetryValue& v : f.vehicle->Telemetry()) {
    if (v.name == "rotor0_rad_s" || v.name == "rotor1_rad_s") rotors += c.rotor.inertia * v.value;
  }
  momentum_B.z() += rotors;
  // The torques are exact; what is left is the Euler step of a body whose axes are a little oblique.
  EXPECT_LT((f.body.state.X_WB.q * momentum_B).norm(), 2e-3 * rotors);
}

TEST(Dynamics, GyroscopicTorqueMakesAFreeSpinPrecess) {
  // Torque-free: the angular momentum in the world stays, although the body's inertia is not round. Semi-implicit
  // Euler errs by its step: |w|² dt a radian turned.
  Free f(QuadrotorConfig{});
  const base::Mat3 I = f.vehicle->body().inertia;
  f.body.state.w_B = {1, 2, 0.5};
  const Vec3 before = f.body.state.X_WB.q * (I * f.body.state.w_B);
  Wrench weightless;
  weightless.force_W = {0, 0, f.vehicle->body().mass * base::kGravity};
  for (int i = 0; i < 1000; ++i) f.body.Step(weightless, kStep);
  const Vec3 after = f.body.state.X_WB.q * (I * f.body.state.w_B);
  EXPECT_LT((after - before).norm(), 5e-3 * before.norm());
}

TEST(Dynamics, BatterySagsUnderFullThrust) {
  Free f(QuadrotorConfig{});
  const double rest = f.vehicle->Battery().voltage;
  f.Run(1000, 1.0);
  EXPECT_LT(f.vehicle->Battery().voltage, rest - 0.5);
  EXPECT_GT(f.vehicle->Battery().current, 40);
}

}  // namespace
}  // namespace alula::vehicles
