#include "scenarios/check/imu_errors_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/check/inertia_check.h"
#include "scenarios/check/statistics.h"
#include "scenarios/check/triad_fit.h"

namespace alula::scenarios::check {
namespace {

using base::Mat3;
using base::Vec3;

constexpr const char* kName = "vehicle0/imu";
constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr double kOven = 20.0;  // K above and below calibration

struct ShakenFit {
  TriadFit gyro, accelerometer;
  double gyro_step = 0.0, accelerometer_step = 0.0;
};

ShakenFit FitShaken(const Rig& bench, const sim::ImuConfig& claimed) {
  const Vec3& a = claimed.orientation;
  const base::Quat q_IB = base::FromYawPitchRoll(a.x(), a.y(), a.z()).conjugate();
  std::vector<Vec3> w, f, gyro, accelerometer;
  Record(bench, nullptr, Shaken, base::Milliseconds(20'200), [&](stack::Measurement&& m) {
    const auto* sample = std::get_if<stack::ImuSample>(&m.data);
    if (sample == nullptr || m.captured < base::Time{} + base::Milliseconds(200)) return;  // the filter settles
    const Rates rates = RatesAt(Shaken, m.captured);
    const Mat3 turn = base::Hat(rates.w_B);
    w.push_back(q_IB * rates.w_B);
    f.push_back(q_IB * Vec3(rates.f_B + (base::Hat(rates.dw_B) + turn * turn) * claimed.position));
    gyro.push_back(sample->angular_velocity);
    accelerometer.push_back(sample->specific_force);
  });
  // Rounding of the arithmetic lies far below 1e-9 of either unit.
  return {FitTriad(w, f, gyro, true), FitTriad(f, f, accelerometer, false), LeastStep(gyro, 1e-9),
          LeastStep(accelerometer, 1e-9)};
}

void AddStep(const std::string& what, double claimed, double step, const char* unit, Report& report) {
  // A continuous sensor's 4000 readings lie closer than a thousandth of any quantum on the market.
  report.Add(Compare(kName, what + " quantum", claimed, step, claimed > 0.0 ? 1e-6 * claimed + 1e-9 : 1e-4, unit));
}

/// Slopes between the hot and the cold oven; without white noise, what is left is rounding to the quantum.
void AddSlopes(const std::string& what, const sim::TriadErrors& claimed, const TriadFit& hot, const TriadFit& cold,
               const char* unit, Report& report) {
  constexpr double kShare = kSigmas / (std::numbers::sqrt2 * kOven);  // of a difference over twice the oven's step
  for (int i = 0; i < 3; ++i) {
    report.Add(Compare(kName, what + " bias per kelvin " + kAxes[i], claimed.bias_per_kelvin[i],
                       (hot.bias[i] - cold.bias[i]) / (2.0 * kOven),
                       kShare * hot.bias_sigma + 1e-3 * std::abs(claimed.bias_per_kelvin[i]) + 1e-9, unit));
    report.Add(Compare(kName, what + " scale per kelvin " + kAxes[i], claimed.scale_per_kelvin[i],
                       (hot.scale[i] - cold.scale[i]) / (2.0 * kOven),
                       kShare * hot.axes_sigma + 1e-3 * std::abs(claimed.scale_per_kelvin[i]) + 1e-9, "1/K"));
  }
}

void AddOven(const Rig& shaken, const sim::ImuConfig& claimed, Report& report) {
  Rig oven = shaken;
  oven.sensors.imu->errors->temperature = {.ambient = kOven};
  const ShakenFit hot = FitShaken(oven, claimed);
  oven.sensors.imu->errors->temperature = {.ambient = -kOven};
  const ShakenFit cold = FitShaken(oven, claimed);
  AddSlopes("gyro", claimed.errors->gyro, hot.gyro, cold.gyro, "rad/s/K", report);
  AddSlopes("accelerometer", claimed.errors->accelerometer, hot.accelerometer, cold.accelerometer, "m/s^2/K", report);
}

std::vector<double> GyroAtRest(const Rig& bench, int axis, base::Duration duration) {
  std::vector<double> all;
  Record(bench, nullptr, Rest({}), duration, [&all, axis](stack::Measurement&& m) {
    if (const auto* s = std::get_if<stack::ImuSample>(&m.data)) all.push_back(s->angular_velocity[axis]);
  });
  return all;
}

/// d(t) = A − B exp(−t/τ) by Gauss–Newton from τ; A, B, τ and their standard deviations.
Solution FitWarmUp(const std::vector<double>& t, const std::vector<double>& d, double tau) {
  const auto n = static_cast<Eigen::Index>(t.size());
  Eigen::VectorXd b = Eigen::Map<const Eigen::VectorXd>(d.data(), n);
  Solution solution;
  Eigen::Vector3d x(b[n - 1], b[n - 1] - b[0], tau);
  for (int round = 0; round < 12; ++round) {
    Eigen::MatrixXd A(n, 3);
    Eigen::VectorXd left(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double s = t[static_cast<std::size_t>(i)], e = std::exp(-s / x[2]);
      A.row(i) << 1.0, -e, -x[1] * e * s / (x[2] * x[2]);
      left[i] = b[i] - (x[0] - x[1] * e);
    }
    solution = LeastSquares(A, left);
    x += solution.x;
    x[2] = std::max(x[2], 0.05 * tau);
  }
  solution.x = x;
  return solution;
}

/// The unit that warms up less the same unit that stays as warm as its surroundings, through the gyro's largest slope.
void AddWarmUp(const Rig& bench, const sim::ImuConfig& claimed, Report& report) {
  const sim::SelfHeatingConfig& said = claimed.errors->temperature;
  int axis = 0;
  const double slope = claimed.errors->gyro.bias_per_kelvin.cwiseAbs().maxCoeff(&axis);
  if (slope <= 0.0 || said.rise <= 0.0) return;
  Rig cool = bench;
  cool.sensors.imu->errors->temperature.rise = 0.0;
  const base::Duration duration = base::Seconds(4.0 * said.time_constant);
  const std::vector<double> warm = GyroAtRest(bench, axis, duration), still = GyroAtRest(cool, axis, duration);
  constexpr std::size_t kMean = 50;
  std::vector<double> t, d;
  for (std::size_t i = 0; i + kMean <= std::min(warm.size(), still.size()); i += kMean) {
    double mean = 0.0;
    for (std::size_t k = i; k < i + kMean; ++k) mean += (warm[k] - still[k]) / kMean;
    t.push_back((static_cast<double>(i) + 0.5 * (kMean - 1)) / claimed.rate.Hz());
    d.push_back(mean / claimed.errors->gyro.bias_per_kelvin[axis]);
  }
  const Solution fit = FitWarmUp(t, d, said.time_constant);
  constexpr double kLeast = 2e-3;  // share: means over 50 samples of a curve, first samples before stamps begin
  report.Add(Compare(kName, "self-heating", said.rise, fit.x[0], kLeast * said.rise + kSigmas * fit.sigma[0], "K"));
  report.Add(Compare(kName, "warm at the start", -said.rise * std::expm1(-said.powered_for / said.time_constant),
                     fit.x[0] - fit.x[1], kLeast * said.rise + kSigmas * std::hypot(fit.sigma[0], fit.sigma[1]), "K"));
  report.Add(Compare(kName, "warm-up time constant", said.time_constant, fit.x[2],
                     kLeast * said.time_constant + kSigmas * fit.sigma[2], "s"));
}

/// Amplitude of a harmonic of one rotor by least squares on its angle at the instants of sampling, whatever they fold.
void AddVibration(const Rig& still, const sim::ImuConfig& claimed, Report& report) {
  const sim::RotorVibrationConfig& said = *claimed.errors->vibration;
  // 3.7 % beside the reference: no harmonic of it lies on a multiple of a round output rate.
  const double ratio = 1.037, speed = ratio * said.reference_speed, pass = said.blades * speed;
  Rig bench = still;
  bench.rotors = {{.speed = speed}};
  const Vec3& a = claimed.orientation;
  const base::Quat q_BI = base::FromYawPitchRoll(a.x(), a.y(), a.z());
  std::vector<Vec3> w, f;
  std::vector<double> t;
  Record(bench, nullptr, Rest({}), base::Milliseconds(20'000), [&](stack::Measurement&& m) {
    const auto* s = std::get_if<stack::ImuSample>(&m.data);
    if (s == nullptr) return;
    w.push_back(q_BI * s->angular_velocity);
    f.push_back(q_BI * s->specific_force);
    t.push_back(m.available.Seconds());  // the instant of sampling: stamps are set back
  });
  const auto n = static_cast<Eigen::Index>(t.size());
  Eigen::MatrixXd A(n, 5);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double s = t[static_cast<std::size_t>(i)];
    A.row(i) << 1.0, std::cos(speed * s), std::sin(speed * s), std::cos(pass * s), std::sin(pass * s);
  }
  const auto gain = [&claimed](double omega) {
    return 1.0 / std::sqrt(1.0 + std::pow(omega / (2.0 * std::numbers::pi * claimed.bandwidth), 4));
  };
  const auto add = [&](const char* what, const std::vector<Vec3>& read, int axis, Eigen::Index column, double expected,
                       const char* unit) {
    Eigen::VectorXd b(n);
    for (Eigen::Index i = 0; i < n; ++i) b[i] = read[static_cast<std::size_t>(i)][axis];
    const Solution s = LeastSquares(A, b);
    report.Add(Compare(kName, what, expected, s.x.segment<2>(column).norm(),
                       kSigmas * s.sigma.segment<2>(column).maxCoeff() + 1e-4 * expected, unit));
  };
  const double once = ratio * ratio * said.imbalance * gain(speed),
               blade = ratio * ratio * said.blade_pass * gain(pass);
  const double gyro_once = ratio * said.gyro_imbalance * gain(speed);
  const double gyro_blade = ratio * said.gyro_blade_pass * gain(pass);
  add("vibration once a revolution, x", f, 0, 1, once, "m/s^2");
  add("vibration once a revolution, y", f, 1, 1, once, "m/s^2");
  add("vibration once a blade, z", f, 2, 3, blade, "m/s^2");
  add("gyro vibration once a revolution, x", w, 0, 1, gyro_once, "rad/s");
  add("gyro vibration once a blade, x", w, 0, 3, gyro_blade, "rad/s");
}

}  // namespace

void CheckImuErrors(const Rig& rig, const sim::ImuConfig& claimed, Report& report) {
  if (!claimed.errors) return;
  Rig bench = ImuOnly(rig);
  if (!bench.sensors.imu->errors) bench.sensors.imu->errors.emplace();
  const auto vibration = bench.sensors.imu->errors->vibration;
  bench.sensors.imu->errors->vibration.reset();
  const Rig warming = bench;
  bench.sensors.imu->errors->temperature = {};
  // White noise and walk have rows of their own; here they would hide g-sensitivity, 3e-5 rad s/m on a data sheet.
  stack::ImuNoise& noise = bench.sensors.imu->noise;
  noise.gyro_noise = noise.accelerometer_noise = noise.gyro_bias_walk = noise.accelerometer_bias_walk = 0.0;
  const ShakenFit shaken = FitShaken(bench, claimed);
  const sim::ImuErrors& said = *claimed.errors;
  // Half a step of rotation lies between mean force and last attitude.
  AddAxes(kName, "gyro", said.gyro, shaken.gyro, 5e-5, report);
  AddAxes(kName, "accelerometer", said.accelerometer, shaken.accelerometer, 2e-4, report);
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      report.Add(Compare(kName, std::string("g-sensitivity of gyro ") + kAxes[i] + " to " + kAxes[k],
                         said.GSensitivity()(i, k), shaken.gyro.G(i, k), 1e-6 + kSigmas * shaken.gyro.G_sigma,
                         "rad*s/m"));
    }
  }
  AddStep("gyro", said.gyro.quantum, shaken.gyro_step, "rad/s", report);
  AddStep("accelerometer", said.accelerometer.quantum, shaken.accelerometer_step, "m/s^2", report);
  AddOven(bench, claimed, report);
  AddWarmUp(warming, claimed, report);
  if (said.vibration) {
    Rig shaking = ImuOnly(rig);
    shaking.sensors.imu->errors = sim::ImuErrors{};
    shaking.sensors.imu->errors->vibration = vibration;
    AddVibration(shaking, claimed, report);
  }
}

}  // namespace alula::scenarios::check
