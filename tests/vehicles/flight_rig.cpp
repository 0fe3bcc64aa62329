#include "tests/vehicles/flight_rig.h"

#include <cmath>

namespace alula::vehicles {

using base::Vec3;

namespace {
constexpr double kStep = 1e-3;           // s
constexpr double kFootStiffness = 3000;  // N/m a leg: 0.6 mm under the weight, 20 Hz, well inside the step
constexpr double kFootDamping = 25;      // N·s/m
constexpr double kFriction = 15;         // N·s/m a leg
constexpr double kSeaLevel = 101325;     // Pa
}  // namespace

RigidBodyRig::RigidBodyRig(const VehicleBody& body)
    : mass_(body.mass), inertia_(body.inertia), inverse_inertia_(body.inertia.inverse()) {
  for (const Part& part : body.parts) {
    if (part.may_touch) feet_B_.emplace_back(part.X_BP.p.x(), part.X_BP.p.y(), -body.standing_height);
  }
  state.X_WB.p.z() = body.standing_height;
}

Wrench RigidBodyRig::Contact() const {
  Wrench w;
  for (const Vec3& p_B : feet_B_) {
    const Vec3 arm = state.X_WB.q * p_B;
    const double depth = -(state.X_WB.p + arm).z();
    if (depth <= 0) continue;
    const Vec3 v = state.v_WB + state.X_WB.q * state.w_B.cross(p_B);
    const double push = std::max(0.0, kFootStiffness * depth - kFootDamping * v.z());
    const Vec3 force(-kFriction * v.x(), -kFriction * v.y(), push);
    w.force_W += force;
    w.torque_W += arm.cross(force);
  }
  return w;
}

Vec3 RigidBodyRig::Step(const Wrench& wrench, double dt) {
  const Wrench contact = ground ? Contact() : Wrench{};
  const Vec3 f_W = (wrench.force_W + contact.force_W) / mass_;
  const base::Quat q = state.X_WB.q;
  const Vec3 torque_B = q.conjugate() * (wrench.torque_W + contact.torque_W);
  state.v_WB += dt * (f_W - Vec3(0, 0, base::kGravity));
  state.w_B += dt * (inverse_inertia_ * (torque_B - state.w_B.cross(inertia_ * state.w_B)));
  state.X_WB.p += dt * state.v_WB;
  state.X_WB.q = (q * base::Exp(dt * state.w_B)).normalized();
  return (q * base::Exp(0.5 * dt * state.w_B)).conjugate() * f_W;
}

FlightRig::FlightRig(const RigOptions& options)
    : body([&options] {
        QuadrotorConfig config;
        config.mass = options.mass;
        return RigidBodyRig(LayOutQuadrotor(config).body);
      }()),
      options_(options),
      noise_(options.seed, "autopilot.imu"),
      vision_noise_(options.seed, "vision"),
      gusts_(options.seed, "wind") {
  QuadrotorConfig config;
  config.mass = options.mass;
  vehicle = MakeQuadrotor(config, "vehicle0");
  autopilot = MakeMulticopterAutopilot(options.autopilot, QuadrotorConfig{});
  // Turn-on biases of an industrial IMU.
  gyro_bias_ = options.sensor_noise ? Vec3(0.005 * noise_.GaussianVec3()) : Vec3::Zero();
  accelerometer_bias_ = options.sensor_noise ? Vec3(0.05 * noise_.GaussianVec3()) : Vec3::Zero();
}

AutopilotSensors FlightRig::Measure(const Vec3& specific_force) {
  const double root_rate = options_.sensor_noise ? std::sqrt(1 / kStep) : 0.0;
  AutopilotSensors s;
  s.imu.angular_velocity = body.state.w_B + gyro_bias_ + 1.7e-4 * root_rate * noise_.GaussianVec3();
  s.imu.specific_force = specific_force + accelerometer_bias_ + 2e-3 * root_rate * noise_.GaussianVec3();
  if (now.ns % 40'000'000 == 0) {
    const double height = body.state.X_WB.p.z() + (options_.sensor_noise ? 0.2 * noise_.Gaussian() : 0.0);
    s.barometer = stack::BaroSample{kSeaLevel * std::exp(-height * base::kGravity / (287.053 * 288.15))};
  }
  s.battery_voltage = vehicle->Battery().voltage;
  return s;
}

void FlightRig::SendEstimate() {
  const RigOptions& o = options_;
  const base::Transform X_OB = X_OW * body.state.X_WB;
  stack::Estimate e;
  e.stamp = now;
  e.X_OB = {X_OB.q * base::Exp(o.vision_attitude_noise * vision_noise_.GaussianVec3()),
            X_OB.p + o.vision_position_noise * vision_noise_.GaussianVec3()};
  e.w_B = body.state.w_B;
  e.pose_covariance.diagonal() << Vec3::Constant(o.vision_position_noise * o.vision_position_noise),
      Vec3::Constant(o.vision_attitude_noise * o.vision_attitude_noise);
  if (o.vision_velocity) {
    e.v_OB = X_OW.q * body.state.v_WB + o.vision_velocity_noise * vision_noise_.GaussianVec3();
    e.velocity_covariance.diagonal().setConstant(std::max(1e-6, o.vision_velocity_noise * o.vision_velocity_noise));
  }
  e.reset_counter = reset_counter;
  estimates_.push_back({now + o.vision_delay, e});
}

Vec3 FlightRig::Wind(double dt) {
  const double keep = std::exp(-dt / 2.0);
  gust_ = keep * gust_ + options_.gust * std::sqrt(1 - keep * keep) * gusts_.GaussianVec3();
  return options_.wind + gust_;
}

void FlightRig::Step() {
  if (vision && now.ns % options_.vision_period.ns == 0) SendEstimate();
  while (!commands_.empty() && commands_.front().due <= now) {
    autopilot->Receive(now, commands_.front().command);
    commands_.pop_front();
  }
  while (!estimates_.empty() && estimates_.front().due <= now) {
    autopilot->Receive(now, estimates_.front().estimate);
    estimates_.pop_front();
  }
  output = autopilot->Step(now, Measure(specific_force_));
  const Wrench wrench = vehicle->Step(body.state, output.actuators, Wind(kStep), base::Milliseconds(1));
  specific_force_ = body.Step(wrench, kStep);
  now += base::Milliseconds(1);
}

void FlightRig::RunFor(double seconds, const std::function<void(base::Time)>& each) {
  const base::Time end = now + base::Seconds(seconds);
  while (now < end) {
    if (each) each(now);
    Step();
  }
}

void FlightRig::TakeOff(double height, double seconds) {
  RunFor(1.2);
  Send(stack::Arm{}, base::Seconds(2));
  RunFor(0.5);
  RunFor(seconds, [&](base::Time t) {
    if (t.ns % 20'000'000 == 0) Send(stack::PositionSetpoint{.p_OB = X_OW * Vec3(0, 0, height)});
  });
}

}  // namespace alula::vehicles
