#include "sim/sensors/imu.h"

#include <cmath>
#include <numbers>

namespace alula::sim {
namespace {

base::Vec3 Clamp(const base::Vec3& v, double range) {
  return range > 0.0 ? base::Vec3(v.cwiseMax(-range).cwiseMin(range)) : v;
}

void DescribeNoise(base::Description& d, stack::ImuNoise& c) {
  d.Field("gyro_noise", c.gyro_noise,
          {.unit = "rad/s/sqrt(Hz)", .meaning = "white noise density of the gyro", .min = 0});
  d.Field("accelerometer_noise", c.accelerometer_noise,
          {.unit = "m/s^2/sqrt(Hz)", .meaning = "white noise density of the accelerometer", .min = 0});
  d.Field("gyro_bias_walk", c.gyro_bias_walk,
          {.unit = "rad/s^2/sqrt(Hz)", .meaning = "random walk of the gyro bias", .min = 0});
  d.Field("accelerometer_bias_walk", c.accelerometer_bias_walk,
          {.unit = "m/s^3/sqrt(Hz)", .meaning = "random walk of the accelerometer bias", .min = 0});
  d.Field("gyro_turn_on_bias", c.gyro_turn_on_bias,
          {.unit = "rad/s", .meaning = "standard deviation of the gyro bias at start", .min = 0});
  d.Field("accelerometer_turn_on_bias", c.accelerometer_turn_on_bias,
          {.unit = "m/s^2", .meaning = "standard deviation of the accelerometer bias at start", .min = 0});
  d.Field("gyro_range", c.gyro_range, {.unit = "rad/s", .meaning = "saturation of the gyro; 0 means none", .min = 0});
  d.Field("accelerometer_range", c.accelerometer_range,
          {.unit = "m/s^2", .meaning = "saturation of the accelerometer; 0 means none", .min = 0});
}

}  // namespace

void Describe(base::Description& d, ImuConfig& c) {
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "output rate"});
  d.Field("position", c.position, {.unit = "m", .meaning = "of the IMU in the body frame"});
  d.Field("orientation", c.orientation, {.unit = "rad", .meaning = "of the IMU in the body frame: yaw, pitch, roll"});
  d.Field("bandwidth", c.bandwidth, {.unit = "Hz", .meaning = "-3 dB of the second-order low-pass", .min = 1});
  DescribeNoise(d, c.noise);
  d.Field("errors", c.errors, {.meaning = "scale, axes, temperature, vibration and quantum; absent: none of them"});
}

ImuConfig AutopilotImuDefaults() {
  ImuConfig config;
  config.rate = {1000, 1};
  config.bandwidth = 250.0;
  return config;
}

void Imu::LowPass::Push(const base::Vec6& in) {
  out = b0 * in + s1;
  s1 = b1 * in - a1 * out + s2;
  s2 = b2 * in - a2 * out;
}

void Imu::LowPass::Settle(const base::Vec6& in) {
  out = in;
  s2 = (b2 - a2) * in;
  s1 = (b1 - a1) * in + s2;
}

Imu::Imu(const ImuConfig& config, base::Duration physics_step, std::uint64_t seed, const std::string& name)
    : config_(config),
      step_(physics_step),
      gyro_stream_(seed, name + ".gyro"),
      accelerometer_stream_(seed, name + ".accelerometer"),
      bias_stream_(seed, name + ".bias") {
  const base::Vec3& a = config.orientation;
  X_BI_ = {base::FromYawPitchRoll(a.x(), a.y(), a.z()), config.position};
  gyro_bias_ = config.noise.gyro_turn_on_bias * bias_stream_.GaussianVec3();
  accelerometer_bias_ = config.noise.accelerometer_turn_on_bias * bias_stream_.GaussianVec3();

  // Butterworth by the bilinear transform with its corner prewarped.
  const double k = std::tan(std::numbers::pi * config.bandwidth * step_.Seconds());
  const double norm = 1.0 / (1.0 + std::numbers::sqrt2 * k + k * k);
  filter_.b0 = k * k * norm;
  filter_.b1 = 2.0 * filter_.b0;
  filter_.b2 = filter_.b0;
  filter_.a1 = 2.0 * (k * k - 1.0) * norm;
  filter_.a2 = (1.0 - std::numbers::sqrt2 * k + k * k) * norm;
  delay_ = base::Seconds(step_.Seconds() * (0.5 + std::numbers::sqrt2 / (2.0 * k)));

  if (config.errors && config.errors->vibration) {
    vibration_.emplace(*config.errors->vibration, 2.0 * std::numbers::pi * config.bandwidth, seed, name + ".vibration");
  }
}

void Imu::Settle(const vehicles::BodyState& state) {
  base::Vec6 rest;
  rest << X_BI_.q.conjugate() * state.w_B, (state.X_WB.q * X_BI_.q).conjugate() * base::Vec3(0.0, 0.0, base::kGravity);
  filter_.Settle(rest);
}

void Imu::Integrate(const vehicles::BodyState& before, const vehicles::BodyState& after,
                    std::span<const vehicles::RotorState> rotors) {
  const base::Vec3 v_WI_before = before.v_WB + before.X_WB.q * before.w_B.cross(X_BI_.p);
  const base::Vec3 v_WI_after = after.v_WB + after.X_WB.q * after.w_B.cross(X_BI_.p);
  const base::Vec3 a_W = (v_WI_after - v_WI_before) / step_.Seconds();
  base::Vec6 truth;
  truth << X_BI_.q.conjugate() * (0.5 * (before.w_B + after.w_B)),
      (after.X_WB.q * X_BI_.q).conjugate() * (a_W + base::Vec3(0.0, 0.0, base::kGravity));
  filter_.Push(truth);
  if (vibration_) vibration_->Turn(rotors, step_);
}

double Imu::Warmth() const {
  return AboveCalibration(config_.errors->temperature, static_cast<double>(samples_) / config_.rate.Hz());
}

base::Vec3 Imu::gyro_bias() const {
  return config_.errors ? base::Vec3(gyro_bias_ + Warmth() * config_.errors->gyro.bias_per_kelvin) : gyro_bias_;
}

base::Vec3 Imu::accelerometer_bias() const {
  return config_.errors ? base::Vec3(accelerometer_bias_ + Warmth() * config_.errors->accelerometer.bias_per_kelvin)
                        : accelerometer_bias_;
}

base::Vec6 Imu::Sensed(base::Duration ago) const {
  if (!config_.errors) return filter_.out;
  base::Vec3 w = filter_.out.head<3>(), f = filter_.out.tail<3>();
  if (vibration_) {
    const RotorVibration::Reading shaken = vibration_->At(ago);
    w += X_BI_.q.conjugate() * shaken.angular_velocity;
    f += X_BI_.q.conjugate() * shaken.specific_force;
  }
  base::Vec6 sensed;
  sensed << SensingMatrix(config_.errors->gyro, Warmth()) * w + config_.errors->GSensitivity() * f,
      SensingMatrix(config_.errors->accelerometer, Warmth()) * f;
  return sensed;
}

stack::ImuSample Imu::Sample(base::Duration ago) {
  const stack::ImuNoise& n = config_.noise;
  const double root_rate = std::sqrt(config_.rate.Hz());
  const base::Vec6 sensed = Sensed(ago);
  base::Vec3 gyro = sensed.head<3>() + gyro_bias() + n.gyro_noise * root_rate * gyro_stream_.GaussianVec3();
  base::Vec3 accelerometer = sensed.tail<3>() + accelerometer_bias() +
                             n.accelerometer_noise * root_rate * accelerometer_stream_.GaussianVec3();
  gyro_bias_ += n.gyro_bias_walk / root_rate * bias_stream_.GaussianVec3();
  accelerometer_bias_ += n.accelerometer_bias_walk / root_rate * bias_stream_.GaussianVec3();
  ++samples_;
  gyro = Clamp(gyro, n.gyro_range);
  accelerometer = Clamp(accelerometer, n.accelerometer_range);
  if (!config_.errors) return {gyro, accelerometer};
  return {Quantise(gyro, config_.errors->gyro.quantum), Quantise(accelerometer, config_.errors->accelerometer.quantum)};
}

}  // namespace alula::sim
