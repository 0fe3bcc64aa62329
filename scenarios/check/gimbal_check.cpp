#include "scenarios/check/gimbal_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

using base::Vec3;

constexpr std::array<const char*, 3> kAxes = {"roll", "pitch", "yaw"};

struct Reading {
  base::Time at;
  Vec3 angles;  // roll, pitch, yaw
};

/// The gimbals alone, without cameras.
Rig GimbalsOnly(const Rig& rig) {
  Rig bench = WithoutCamerasAndImu(rig);
  bench.sensors.barometer.reset();
  bench.sensors.magnetometer.reset();
  bench.sensors.position_reference.reset();
  bench.sensors.gnss.reset();
  bench.sensors.battery_rate = bench.sensors.status_rate = {1, 1};
  return bench;
}

std::vector<Reading> ReadEncoders(const Rig& bench, stack::SensorId sensor, base::Duration duration,
                                  const std::vector<Turn>& turns) {
  std::vector<Reading> readings;
  const auto keep = [&](stack::Measurement&& m) {
    const auto* a = std::get_if<stack::GimbalAngles>(&m.data);
    if (a != nullptr && m.sensor == sensor) readings.push_back({m.captured, {a->roll, a->pitch, a->yaw}});
  };
  Record(bench, nullptr, Rest({}), duration, keep, turns);
  return readings;
}

Turn To(double seconds, int gimbal, const Vec3& angles) {
  return {base::Time{} + base::Seconds(seconds),
          {.gimbal = gimbal, .roll = angles[0], .pitch = angles[1], .yaw = angles[2]}};
}

/// Sum of squared differences to steps from `low` to `high` and back every `period`, followed with a lag.
double Misfit(const std::vector<Reading>& readings, const Vec3& low, const Vec3& high, double period, double lag) {
  double sum = 0.0;
  for (const Reading& reading : readings) {
    const double s = reading.at.Seconds();
    if (s < period) continue;
    const bool up = static_cast<int>(s / period) % 2 == 1;
    const double gone = std::exp(-(s - period * std::floor(s / period)) / lag);
    const Vec3 model = up ? Vec3(high + gone * (low - high)) : Vec3(low + gone * (high - low));
    sum += (reading.angles - model).squaredNorm();
  }
  return sum;
}

/// Lag with the least misfit, by golden section.
double FitLag(const std::vector<Reading>& readings, const Vec3& low, const Vec3& high, double period, double guess) {
  constexpr double kGolden = 0.6180339887498949;
  double a = 0.2 * guess, b = 5.0 * guess;
  for (int i = 0; i < 60; ++i) {
    const double left = b - kGolden * (b - a), right = a + kGolden * (b - a);
    Misfit(readings, low, high, period, left) < Misfit(readings, low, high, period, right) ? b = right : a = left;
  }
  return 0.5 * (a + b);
}

void AddLag(const Rig& bench, int gimbal, stack::SensorId sensor, const std::string& name,
            const sim::GimbalConfig& claimed, Report& report) {
  const double lag = claimed.lag.Seconds(), period = std::max(12.0 * lag, 10.0 * claimed.rate.Period());
  // Steps small enough that the axes never reach their highest speed, between stops.
  const Vec3 middle = 0.5 * (claimed.low + claimed.high);
  const Vec3 step = (0.25 * (claimed.high - claimed.low)).cwiseMin(0.4 * claimed.fastest * lag);
  const Vec3 low = middle - step, high = middle + step;
  constexpr int kSteps = 41;
  std::vector<Turn> turns;
  for (int i = 0; i < kSteps; ++i) turns.push_back(To(i * period, gimbal, i % 2 == 1 ? high : low));
  const std::vector<Reading> readings = ReadEncoders(bench, sensor, base::Seconds(kSteps * period), turns);
  const double swing = step.norm();
  const double error = claimed.encoder_noise * std::sqrt(3.0) / std::max(swing, 1e-9) / std::sqrt(kSteps / 2.0);
  report.Add(Compare(name, "lag", lag,
                     swing > 1e-6 ? FitLag(readings, low, high, period, lag) : std::numeric_limits<double>::quiet_NaN(),
                     lag * (0.01 + kSigmas * error) + 0.5 * bench.step.Seconds(), "s"));
}

void AddStops(const Rig& bench, int gimbal, stack::SensorId sensor, const std::string& name,
              const sim::GimbalConfig& claimed, Report& report) {
  const double travel = (claimed.high - claimed.low).maxCoeff();
  const double hold = 1.0 + travel / claimed.fastest + 12.0 * claimed.lag.Seconds();
  const double rest = std::max(1.0, 100.0 * claimed.rate.Period());
  const Vec3 beyond = Vec3::Constant(100.0);
  const std::vector<Reading> readings = ReadEncoders(bench, sensor, base::Seconds(2.0 * (hold + rest)),
                                                     {To(0.0, gimbal, -beyond), To(hold + rest, gimbal, beyond)});
  std::vector<double> noise;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> low, high;
    double fastest = 0.0;
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const double s = readings[i].at.Seconds(), angle = readings[i].angles[axis];
      if (s > hold && s < hold + rest) low.push_back(angle);
      if (s > 2.0 * hold + rest) high.push_back(angle);
      // Over a tenth of the way or ten readings, so that the encoders' noise does not count.
      const std::size_t back = 10;
      if (s > hold + rest && s < 2.0 * hold + rest && i >= back) {
        const double before = readings[i - back].at.Seconds();
        if (before > hold + rest + bench.step.Seconds()) {
          fastest = std::max(fastest, (angle - readings[i - back].angles[axis]) / (s - before));
        }
      }
    }
    const Spread at_low = SpreadOf(low), at_high = SpreadOf(high);
    const double tolerance =
        1e-4 + kSigmas * claimed.encoder_noise / std::sqrt(static_cast<double>(std::min(low.size(), high.size())));
    const std::string axis_name = kAxes[axis];
    report.Add(Compare(name, axis_name + ", lower stop", claimed.low[axis], at_low.mean, tolerance, "rad"));
    report.Add(Compare(name, axis_name + ", upper stop", claimed.high[axis], at_high.mean, tolerance, "rad"));
    for (const double angle : low) noise.push_back(angle - at_low.mean);
    for (const double angle : high) noise.push_back(angle - at_high.mean);
    // The lag takes over the last fastest · lag; what is left of the way must last for the ten readings.
    const double steady = claimed.high[axis] - claimed.low[axis] - claimed.fastest * claimed.lag.Seconds();
    if (steady > 1.3 * 11.0 * claimed.rate.Period() * claimed.fastest) {
      report.Add(Compare(name, axis_name + ", highest speed", claimed.fastest, fastest,
                         0.01 * claimed.fastest + 6.0 * claimed.encoder_noise / (10.0 * claimed.rate.Period()),
                         "rad/s"));
    }
  }
  report.Add(Compare(name, "encoder noise, 1 sigma", claimed.encoder_noise, SpreadOf(noise).sigma,
                     kSigmas * SigmaError(claimed.encoder_noise, static_cast<double>(noise.size())) + 1e-9, "rad"));
  const double span = (readings.back().at - readings.front().at).Seconds();
  report.Add(Compare(name, "rate", claimed.rate.Hz(), (static_cast<double>(readings.size()) - 1.0) / span,
                     1e-6 * claimed.rate.Hz(), "Hz"));
}

/// A stabilised mount that wants to be level on a level body stands off by its horizon's error.
void AddLevelling(const Rig& bench, int gimbal, stack::SensorId sensor, const std::string& name,
                  const sim::GimbalConfig& claimed, Report& report) {
  constexpr int kSeeds = 200;
  std::vector<double> tilts;
  for (int i = 0; i < kSeeds; ++i) {
    Rig one = bench;
    one.seed = bench.seed + static_cast<std::uint64_t>(i);
    one.sensors.gimbals[static_cast<std::size_t>(gimbal)].start.setZero();
    one.sensors.gimbals[static_cast<std::size_t>(gimbal)].encoder_noise = 0.0;
    const Reading reading = ReadEncoders(one, sensor, base::Milliseconds(1), {}).front();
    tilts.push_back(reading.angles[0]);
    tilts.push_back(reading.angles[1]);
  }
  report.Add(Compare(name, "levelling error, 1 sigma", claimed.levelling_error, SpreadOf(tilts).sigma,
                     kSigmas * SigmaError(claimed.levelling_error, 2.0 * kSeeds) + 1e-9, "rad"));
}

}  // namespace

void CheckGimbal(const Rig& rig, int gimbal, const sim::GimbalConfig& claimed, Report& report) {
  const Rig bench = GimbalsOnly(rig);
  Rig loose = bench;  // told angles against the body: what the stops and the lag are of
  for (sim::GimbalConfig& config : loose.sensors.gimbals) config.stabilised = false;
  const std::string name = std::string(kVehicle) + "/gimbal." + claimed.name;
  const stack::Calibration calibration = sim::TrueCalibration(rig.sensors, rig.body, kVehicle);
  const stack::SensorId sensor = calibration.gimbals[static_cast<std::size_t>(gimbal)].sensor;
  AddLag(loose, gimbal, sensor, name, claimed, report);
  AddStops(loose, gimbal, sensor, name, claimed, report);
  if (claimed.stabilised) AddLevelling(bench, gimbal, sensor, name, claimed, report);
}

}  // namespace alula::scenarios::check
