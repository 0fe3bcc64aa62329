#include "vehicles/multicopter_autopilot.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vehicles/multicopter_mixer.h"

namespace alula::vehicles {

namespace {

using base::Time;
using base::Vec3;

constexpr double kTickRate = 1000.0;        // Hz
constexpr double kTakeoffRamp = 1.0;        // s until the full climb rate is allowed
constexpr double kThrustReserve = 0.9;      // of full thrust for the position loop; the rest turns the vehicle
constexpr double kVoltageSmoothing = 0.05;  // s
// Height per relative pressure change, R T / g of the standard atmosphere at 15 °C, m.
constexpr double kScaleHeight = 287.053 * 288.15 / base::kGravity;

class MulticopterAutopilot final : public Autopilot {
 public:
  MulticopterAutopilot(const MulticopterAutopilotConfig& config, const QuadrotorConfig& vehicle)
      : MulticopterAutopilot(config, vehicle, LayOutAssumed(config, vehicle)) {}

  void Receive(Time, const stack::Command& command) override { modes_.Receive(command); }
  void Receive(Time, const stack::Estimate& estimate) override { estimates_.push_back(estimate); }

  AutopilotOutput Step(Time now, const AutopilotSensors& sensors) override {
    const double dt = last_tick_ && now > *last_tick_ ? (now - *last_tick_).Seconds() : 1.0 / kTickRate;
    last_tick_ = now;
    const FlightSituation situation = Estimate(now, sensors, dt);
    const FlightGoal goal = modes_.Step(situation, dt);
    AutopilotOutput output;
    output.actuators.motors = goal.fly ? Fly(goal, sensors.imu, dt) : Idle(goal.armed, sensors.imu, dt);
    JudgeLanding(goal, sensors.imu, dt);
    output.status = {.mode = modes_.mode(),
                     .armed = goal.armed,
                     .ready_to_arm = situation.ready_to_arm,
                     .landed = detector_.landed(),
                     .thrust = collective_ / (kRotors * full_thrust_)};
    return output;
  }

  std::optional<BodyState> OwnEstimate() const override {
    if (!filter_.initialised()) return std::nullopt;
    const NavigationState& x = filter_.state();
    return BodyState{.X_WB = {x.q_OB, x.p_OB}, .v_WB = x.v_OB, .w_B = rates_.rate()};
  }

 private:
  static QuadrotorLayout LayOutAssumed(const MulticopterAutopilotConfig& config, QuadrotorConfig vehicle) {
    vehicle.mass = config.assumed_mass;
    return LayOutQuadrotor(vehicle);
  }

  MulticopterAutopilot(const MulticopterAutopilotConfig& config, const QuadrotorConfig& vehicle,
                       const QuadrotorLayout& assumed)
      : config_(config),
        inertia_(assumed.body.inertia),
        full_thrust_(ThrustConstant(vehicle.rotor, vehicle.air_density) * vehicle.rotor.maximum_speed *
                     vehicle.rotor.maximum_speed),
        nominal_voltage_(vehicle.rotor.nominal_voltage),
        voltage_(vehicle.rotor.nominal_voltage),
        filter_(config.filter),
        modes_(config.failsafe),
        detector_(config.landing),
        position_(config.position),
        rates_(config.attitude, kTickRate),
        mixer_(assumed.rotors, TorqueConstant(vehicle.rotor, vehicle.air_density) /
                                   ThrustConstant(vehicle.rotor, vehicle.air_density)) {}

  FlightSituation Estimate(Time now, const AutopilotSensors& sensors, double dt) {
    if (sensors.battery_voltage > 0) {
      voltage_ += std::min(1.0, dt / kVoltageSmoothing) * (sensors.battery_voltage - voltage_);
    }
    std::optional<double> height;
    if (sensors.barometer) {
      if (!reference_pressure_) reference_pressure_ = sensors.barometer->pressure;
      height = kScaleHeight * std::log(*reference_pressure_ / sensors.barometer->pressure);
    }
    filter_.AddInertial(now, sensors.imu, height);
    for (const stack::Estimate& e : estimates_) {
      filter_.AddEstimate(now, e);
      if (filter_.jumps() == jumps_) continue;
      jumps_ = filter_.jumps();
      modes_.Shift(filter_.last_jump().position, filter_.last_jump().yaw);
    }
    estimates_.clear();

    const NavigationState& x = filter_.state();
    const bool trusted = filter_.initialised() && now - *filter_.last_fused() <= config_.failsafe.estimate_timeout;
    return {.now = now,
            .ready_to_arm = trusted,
            .position_trusted = trusted,
            .landed = detector_.landed(),
            .p_OB = x.p_OB,
            .v_OB = x.v_OB,
            .yaw = base::Yaw(x.q_OB)};
  }

  std::vector<double> Fly(const FlightGoal& goal, const stack::ImuSample& imu, double dt) {
    const NavigationState& x = filter_.state();
    flying_for_ += dt;
    const bool airborne = !detector_.landed();
    const double relative_voltage = voltage_ / nominal_voltage_;
    const double least = full_thrust_ * config_.idle_command * config_.idle_command;
    // A battery that has collapsed does not give more than the least.
    const double most = std::max(least, full_thrust_ * std::min(1.0, relative_voltage * relative_voltage));

    const double climb = config_.position.maximum_climb * std::min(1.0, flying_for_ / kTakeoffRamp);
    Vec3 f = position_.Step(goal.setpoint, x.p_OB, x.v_OB, kThrustReserve * kRotors * most / config_.assumed_mass,
                            climb, airborne && !detector_.contact(), dt);
    if (goal.level) f.head<2>().setZero();
    if (detector_.contact() && goal.descending) f *= 1 - detector_.relief();

    const base::Quat q_sp =
        AttitudeFor(f + Vec3(0, 0, 1e-3), goal.setpoint.yaw);  // upright where no thrust is wanted at all
    const Vec3 w_sp = RateSetpoint(config_.attitude, x.q_OB, q_sp, goal.setpoint.yaw_rate);
    const Vec3 turn = rates_.Step(w_sp, imu.angular_velocity - x.gyro_bias, saturated_, airborne, dt);
    const Vec3& w = rates_.rate();
    const Vec3 torque = inertia_ * turn + w.cross(inertia_ * w);

    const double wanted = config_.assumed_mass * f.dot(x.q_OB * Vec3::UnitZ());
    const MulticopterMixer::Result mixed =
        mixer_.Mix(std::clamp(wanted, kRotors * least, kRotors * most), torque, least, most);
    saturated_ = mixed.saturated;
    collective_ = mixed.collective;

    std::vector<double> motors(kRotors);
    for (int i = 0; i < kRotors; ++i) {
      motors[static_cast<std::size_t>(i)] =
          std::clamp(std::sqrt(mixed.thrusts[i] / full_thrust_) / relative_voltage, 0.0, 1.0);
    }
    return motors;
  }

  std::vector<double> Idle(bool armed, const stack::ImuSample& imu, double dt) {
    // The gyro filter keeps running, so that a take-off starts from its settled state.
    rates_.Step(Vec3::Zero(), imu.angular_velocity - filter_.state().gyro_bias, Vec3::Zero(), false, dt);
    rates_.Reset();
    position_.Reset();
    saturated_.setZero();
    flying_for_ = 0;
    const double command = armed ? config_.idle_command : 0.0;
    collective_ = kRotors * full_thrust_ * command * command;
    return std::vector<double>(kRotors, command);
  }

  void JudgeLanding(const FlightGoal& goal, const stack::ImuSample& imu, double dt) {
    if (!goal.fly) {
      detector_.SetLanded(true);
      return;
    }
    const NavigationState& x = filter_.state();
    const double weight = config_.assumed_mass * base::kGravity;
    if (detector_.landed() && !goal.descending) {
      // It leaves the ground when the thrust carries it.
      if (collective_ > 0.9 * weight) detector_.SetLanded(false);
      return;
    }
    const double load = (imu.specific_force - x.accelerometer_bias).z() / base::kGravity;
    detector_.Step(goal.descending, collective_ / weight, load, x.v_OB, dt);
  }

  MulticopterAutopilotConfig config_;
  base::Mat3 inertia_;
  double full_thrust_;      // N, one rotor at nominal voltage
  double nominal_voltage_;  // V
  double voltage_;          // V, smoothed
  std::optional<double> reference_pressure_;
  std::optional<Time> last_tick_;
  std::vector<stack::Estimate> estimates_;
  ErrorStateFilter filter_;
  std::uint32_t jumps_ = 0;
  FlightModes modes_;
  LandDetector detector_;
  PositionControl position_;
  RateControl rates_;
  MulticopterMixer mixer_;
  Vec3 saturated_ = Vec3::Zero();
  double collective_ = 0.0;  // N, commanded
  double flying_for_ = 0.0;  // s
};

}  // namespace

void Describe(base::Description& d, MulticopterAutopilotConfig& c) {
  d.Field("assumed_mass", c.assumed_mass,
          {.unit = "kg", .meaning = "mass that the autopilot was set up with", .min = 0.05, .max = 100});
  d.Field("idle_command", c.idle_command,
          {.meaning = "motor command of an armed rotor on the ground", .min = 0.0, .max = 0.3});
  d.Field("filter", c.filter, {.meaning = "state estimation"});
  d.Field("position", c.position, {.meaning = "position and velocity control"});
  d.Field("attitude", c.attitude, {.meaning = "attitude and rate control"});
  d.Field("failsafe", c.failsafe, {.meaning = "silence and landing"});
  d.Field("landing", c.landing, {.meaning = "detection of the ground"});
}

std::unique_ptr<Autopilot> MakeMulticopterAutopilot(const MulticopterAutopilotConfig& config,
                                                    const QuadrotorConfig& vehicle) {
  return std::make_unique<MulticopterAutopilot>(config, vehicle);
}

}  // namespace alula::vehicles
