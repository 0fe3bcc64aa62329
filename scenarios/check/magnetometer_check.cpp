#include "scenarios/check/magnetometer_check.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "scenarios/check/statistics.h"
#include "scenarios/check/triad_fit.h"

namespace alula::scenarios::check {
namespace {

using base::Vec3;

constexpr const char* kName = "vehicle0/magnetometer";
constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr double kMicro = 1e6;       // µT of a tesla; rows are in µT
constexpr double kSamples = 4000.0;  // sigma of three axes to 0.6 %

/// The magnetometer alone, without current, stepped from sample to sample: nothing on this bench is integrated.
Rig MagnetometerOnly(const Rig& rig, base::Rate rate) {
  Rig bench = rig;
  bench.sensors = {};
  bench.sensors.imu.reset();
  bench.sensors.barometer.reset();
  bench.sensors.magnetometer = rig.sensors.magnetometer;
  bench.sensors.battery_rate = bench.sensors.status_rate = {1, 60};
  bench.step = base::Seconds(rate.Period());
  bench.battery.current = 0.0;
  return bench;
}

struct Readings {
  std::vector<base::Time> t;
  std::vector<Vec3> field;  // µT
};

Readings Read(const Rig& bench, const Motion& motion, double samples) {
  Readings all;
  Record(bench, nullptr, motion, base::Seconds(samples * bench.step.Seconds()), [&all](stack::Measurement&& m) {
    const auto* s = std::get_if<stack::MagSample>(&m.data);
    if (s == nullptr) return;
    all.t.push_back(m.captured);
    all.field.push_back(kMicro * s->magnetic_field);
  });
  return all;
}

/// Standard deviation about the mean of each axis, all axes together.
double SigmaOf(const std::vector<Vec3>& vectors) {
  double squares = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Vec3& v : vectors) values.push_back(v[axis]);
    const double sigma = SpreadOf(values).sigma;
    squares += sigma * sigma;
  }
  return std::sqrt(squares / 3.0);
}

void AddRest(const Rig& noisy, const sim::MagnetometerConfig& claimed, Report& report) {
  const Readings rest = Read(noisy, Rest({}), kSamples);
  report.Add(Compare(kName, "rate", claimed.rate.Hz(),
                     (static_cast<double>(rest.t.size()) - 1.0) / (rest.t.back() - rest.t.front()).Seconds(),
                     1e-6 * claimed.rate.Hz(), "Hz"));
  const double noise = kMicro * claimed.noise;
  report.Add(Compare(kName, "noise, 1 sigma", noise, SigmaOf(rest.field),
                     kSigmas * SigmaError(noise, 3.0 * kSamples) + 1e-9, "uT"));
}

void AddHardIron(const Rig& quiet, const sim::MagnetometerConfig& claimed, Report& report) {
  constexpr int kSeeds = 400;
  std::vector<Vec3> offsets;
  for (int i = 0; i < kSeeds; ++i) {
    Rig one = quiet;
    one.seed = quiet.seed + static_cast<std::uint64_t>(i);
    offsets.push_back(Read(one, Rest({}), 1.0).field.front());
  }
  const double sigma = kMicro * claimed.hard_iron_sigma;
  report.Add(Compare(kName, "hard iron, 1 sigma", sigma, SigmaOf(offsets),
                     kSigmas * SigmaError(sigma, 3.0 * kSeeds) + 1e-9, "uT"));
}

/// Turns about all axes, a radian of yaw in 70 samples.
Motion Tumble(double period) {
  return [period](base::Time t) {
    const double s = t.Seconds() / (70.0 * period);
    return vehicles::BodyState{{base::FromYawPitchRoll(s, 1.3 * std::sin(0.37 * s), 0.61 * s), Vec3::Zero()}};
  };
}

struct TumbledFit {
  TriadFit triad;  // bias in µT
  double step = 0.0;
};

TumbledFit FitTumbled(const Rig& bench, const base::Quat& q_BM) {
  const Motion tumble = Tumble(bench.step.Seconds());
  const Readings read = Read(bench, tumble, kSamples);
  std::vector<Vec3> field;
  for (const base::Time t : read.t) field.push_back(kMicro * ((tumble(t).X_WB.q * q_BM).conjugate() * bench.B_W));
  return {FitTriad(field, field, read.field, false), LeastStep(read.field, 1e-9)};
}

void AddTumbled(const Rig& quantised, const sim::MagnetometerConfig& claimed, Report& report) {
  constexpr double kCurrent = 20.0;  // A
  const Vec3& a = claimed.orientation;
  const base::Quat q_BM = base::FromYawPitchRoll(a.x(), a.y(), a.z());
  const TumbledFit still = FitTumbled(quantised, q_BM);
  Rig loaded = quantised;
  loaded.battery.current = kCurrent;
  const TumbledFit under_load = FitTumbled(loaded, q_BM);
  AddAxes(kName, "soft iron", claimed.soft_iron, still.triad, 1e-6, report);
  // What current adds turns with the body, as hard iron does: Δb = A R_MB κ ΔI.
  const Vec3 per_ampere = q_BM * Vec3(still.triad.M.inverse() * (under_load.triad.bias - still.triad.bias)) / kCurrent;
  for (int i = 0; i < 3; ++i) {
    report.Add(Compare(kName, std::string("field per ampere ") + kAxes[i], kMicro * claimed.per_ampere[i],
                       per_ampere[i], 2.0 * kSigmas * still.triad.bias_sigma / kCurrent + 1e-7, "uT/A"));
  }
  // A continuous sensor's readings lie closer than a nanotesla.
  const double quantum = kMicro * claimed.quantum;
  report.Add(
      Compare(kName, "quantum", quantum, still.step, claimed.quantum > 0.0 ? 1e-6 * quantum + 1e-9 : 1e-3, "uT"));
}

void AddSaturation(const Rig& quiet, const sim::MagnetometerConfig& claimed, Report& report) {
  const Vec3& a = claimed.orientation;
  const base::Quat q_BM = base::FromYawPitchRoll(a.x(), a.y(), a.z());
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Rig coil = quiet;
    coil.B_W = 4.0 * claimed.range * (q_BM * Vec3(Vec3::Unit(axis)));
    largest = std::max(largest, Read(coil, Rest({}), 1.0).field.front().cwiseAbs().maxCoeff());
  }
  report.Add(Compare(kName, "saturation", kMicro * claimed.range, largest, 1e-9 * kMicro * claimed.range, "uT"));
}

}  // namespace

void CheckMagnetometer(const Rig& rig, const sim::MagnetometerConfig& claimed, Report& report) {
  const Rig bench = MagnetometerOnly(rig, claimed.rate);
  Rig noisy = bench;  // each cause alone: rounding is measured where the field changes and nothing else does
  noisy.sensors.magnetometer->quantum = 0.0;
  Rig quiet = noisy;
  quiet.sensors.magnetometer->noise = 0.0;
  Rig quantised = bench;
  quantised.sensors.magnetometer->noise = 0.0;
  AddRest(noisy, claimed, report);
  AddHardIron(quiet, claimed, report);
  AddTumbled(quantised, claimed, report);
  AddSaturation(quiet, claimed, report);
}

}  // namespace alula::scenarios::check
