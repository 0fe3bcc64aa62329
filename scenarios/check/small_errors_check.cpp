#include "scenarios/check/small_errors_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

using base::Vec3;

constexpr const char* kBarometer = "vehicle0/barometer";
constexpr const char* kBattery = "vehicle0/battery";
// Correlation times in a record: sigma of a Gauss–Markov process to 1/√n = 3 %, its correlation time to √(2/n) = 4.5 %.
constexpr double kCorrelationTimes = 1000.0;

/// One kind of sensor alone, stepped from sample to sample: nothing on this bench is integrated.
Rig Alone(const Rig& rig, base::Rate rate) {
  Rig bench = WithoutCamerasAndImu(rig);
  bench.sensors.gimbals.clear();
  bench.sensors.magnetometer.reset();
  bench.sensors.battery_rate = bench.sensors.status_rate = {1, 60};
  bench.step = base::Seconds(rate.Period());
  return bench;
}

/// A first-order Gauss–Markov process out of samples numbered `seq` (some may be missing): standard deviation, and
/// correlation time by regression of each sample on the one `lag` before, τ = −lag·period / ln φ.
struct Wandering {
  double sigma = 0.0;
  double time = NAN;
};
Wandering FitWandering(const std::vector<std::uint32_t>& seq, const std::vector<double>& x, double period,
                       std::uint32_t lag) {
  const double mean = SpreadOf(x).mean;
  Wandering found{.sigma = SpreadOf(x).sigma};
  double product = 0.0, square = 0.0;
  std::size_t k = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    while (k < x.size() && seq[k] < seq[i] + lag) ++k;
    if (k >= x.size() || seq[k] != seq[i] + lag) continue;
    product += (x[i] - mean) * (x[k] - mean);
    square += (x[i] - mean) * (x[i] - mean);
  }
  const double phi = product / square;
  if (phi > 0.0 && phi < 1.0) found.time = -static_cast<double>(lag) * period / std::log(phi);
  return found;
}

std::uint32_t LagFor(double time, double period) {
  return static_cast<std::uint32_t>(std::max(1.0, std::round(0.3 * time / period)));
}

void AddWandering(const char* name, const std::string& what, double sigma, double time, const Wandering& found,
                  const char* unit, Report& report) {
  report.Add(Compare(name, what + ", 1 sigma", sigma, found.sigma,
                     kSigmas * sigma / std::sqrt(kCorrelationTimes) + 1e-9, unit));
  if (sigma <= 0.0) return;
  // Regression over 0.3 τ: √(2/n) grows by a factor of √((e^0.6 − 1) / 0.6) = 1.2.
  report.Add(Compare(name, what + "'s correlation time", time, found.time,
                     kSigmas * 1.2 * time * std::sqrt(2.0 / kCorrelationTimes), "s"));
}

Rig QuietBarometer(const Rig& rig, base::Rate rate) {
  Rig bench = Alone(rig, rate);
  bench.sensors.position_reference.reset();
  bench.sensors.gnss.reset();
  bench.sensors.barometer->noise = bench.sensors.barometer->weather_sigma = 0.0;
  return bench;
}

double FirstPressure(const Rig& bench) {
  double pressure = NAN;
  Record(bench, nullptr, Rest({}), {}, [&pressure](stack::Measurement&& m) {
    if (const auto* s = std::get_if<stack::BaroSample>(&m.data)) pressure = s->pressure;
  });
  return pressure;
}

void AddDrift(const Rig& bench, const sim::BarometerConfig& claimed, Report& report) {
  std::vector<std::uint32_t> seq;
  std::vector<double> pressure;
  Record(bench, nullptr, Rest({}), base::Seconds(kCorrelationTimes * claimed.drift_time), [&](stack::Measurement&& m) {
    const auto* s = std::get_if<stack::BaroSample>(&m.data);
    if (s == nullptr) return;
    seq.push_back(m.seq);
    pressure.push_back(s->pressure);
  });
  const double period = claimed.rate.Period();
  AddWandering(kBarometer, "drift", claimed.drift, claimed.drift_time,
               FitWandering(seq, pressure, period, LagFor(claimed.drift_time, period)), "Pa", report);
}

void AddAir(const Rig& still, const sim::BarometerConfig& claimed, Report& report) {
  constexpr const char* kWind[] = {"wind pressure, x", "wind pressure, y", "wind pressure, z"};
  constexpr double kSpeed = 10.0;  // m/s: ½ρv² = 61.25 Pa
  const double calm = FirstPressure(still);
  for (int i = 0; i < 3; ++i) {
    Rig fan = still;
    fan.v_air_B[i] = kSpeed;
    report.Add(Compare(kBarometer, kWind[i], claimed.wind_pressure[i],
                       (FirstPressure(fan) - calm) / (0.5 * 1.225 * kSpeed * kSpeed), 1e-9, "1"));
  }
  Rig floor = still;
  constexpr double kRadius = 0.1, kLoading = 100.0;  // m, Pa; at z = 2R the cushion has 1/64 of it
  floor.rotors = {{.speed = 500.0, .thrust = kLoading * std::numbers::pi * kRadius * kRadius, .radius = kRadius}};
  floor.rotor_height = 2.0 * kRadius;
  report.Add(Compare(kBarometer, "ground pressure", claimed.ground_pressure,
                     (FirstPressure(floor) - calm) / (kLoading / 64.0), 1e-9, "1"));
}

/// `bench`: with the one source of fixes alone, without white noise.
void AddSatellites(const Rig& bench, const char* name, base::Rate rate, const sim::GnssConfig& said, Report& report) {
  const double period = rate.Period(), span = kCorrelationTimes * said.correlation_time;
  std::vector<std::uint32_t> seq;
  std::vector<double> x, y, z;
  double sigma = NAN, in_outages = 0.0, planned = 0.0;
  const auto lost = [&said](base::Time t) {
    return std::any_of(said.outages.begin(), said.outages.end(),
                       [since = t - base::Time{}](const sim::Outage& o) { return o.from <= since && since < o.until; });
  };
  Record(bench, nullptr, Rest({}), base::Seconds(span), [&](stack::Measurement&& m) {
    const auto* fix = std::get_if<stack::PositionFix>(&m.data);
    if (fix == nullptr) return;
    if (lost(m.captured)) ++in_outages;
    seq.push_back(m.seq);
    x.push_back(fix->X_WB.p.x());
    y.push_back(fix->X_WB.p.y());
    z.push_back(fix->X_WB.p.z());
    sigma = fix->attitude_sigma;
  });
  if (seq.size() < 100) {
    report.Add(Compare(name, "fixes", span / period, static_cast<double>(seq.size()), 0.0, "1"));
    return;
  }
  const std::uint32_t lag = LagFor(said.correlation_time, period);
  const Wandering fx = FitWandering(seq, x, period, lag), fy = FitWandering(seq, y, period, lag);
  AddWandering(name, "wandering x", said.horizontal, said.correlation_time, fx, "m", report);
  AddWandering(name, "wandering y", said.horizontal, said.correlation_time, fy, "m", report);
  AddWandering(name, "wandering z", said.vertical, said.correlation_time, FitWandering(seq, z, period, lag), "m",
               report);
  report.Add(Compare(name, "attitude not measured, sigma", sim::kUnmeasuredAttitude, sigma, 0.0, "rad"));
  report.Add(Compare(name, "fixes in planned outages", 0.0, in_outages, 0.0, "1"));
  // Renewal: an outage of mean L (rounded up to whole fixes: half a period more) after 1/rate of fixes. Of n outages
  // the lost time has a relative standard deviation of √(2/n).
  for (std::uint32_t k = 0; k <= seq.back(); ++k) planned += lost(rate.SampleTime(k)) ? 1.0 : 0.0;
  const double taken = static_cast<double>(seq.back()) + 1.0 - planned;
  const double length = said.outage_length + 0.5 * period;
  const double share = said.outage_rate * length / (1.0 + said.outage_rate * length);
  const double outages = std::max(1.0, span * said.outage_rate / (1.0 + said.outage_rate * length));
  report.Add(Compare(name, "share of fixes lost by chance", share, 1.0 - static_cast<double>(seq.size()) / taken,
                     kSigmas * share * std::sqrt(2.0 / outages) + 1e-9, "1"));
}

}  // namespace

void CheckBarometerErrors(const Rig& rig, const sim::BarometerConfig& claimed, Report& report) {
  const sim::BarometerConfig& built = *rig.sensors.barometer;
  Rig bench = QuietBarometer(rig, claimed.rate);
  if (claimed.drift > 0.0 || built.drift > 0.0) AddDrift(bench, claimed, report);
  bench.sensors.barometer->drift = 0.0;
  AddAir(bench, claimed, report);
}

void CheckGnss(const Rig& rig, const sim::PositionReferenceConfig& claimed, Report& report) {
  if (!claimed.gnss) return;
  Rig bench = Alone(rig, claimed.rate);
  bench.sensors.barometer.reset();
  bench.sensors.gnss.reset();
  bench.sensors.position_reference->position_noise = 0.0;
  AddSatellites(bench, "vehicle0/position_reference", claimed.rate, *claimed.gnss, report);
}

void CheckGnss(const Rig& rig, const sim::GnssReceiverConfig& claimed, Report& report) {
  Rig bench = Alone(rig, claimed.rate);
  bench.sensors.barometer.reset();
  bench.sensors.position_reference.reset();
  bench.sensors.gnss->noise = 0.0;
  AddSatellites(bench, "vehicle0/gnss", claimed.rate, claimed, report);
}

void CheckBatteryGauge(const Rig& rig, const sim::SensorsConfig& claimed, Report& report) {
  constexpr double kSamples = 4000.0;
  const sim::BatteryGaugeConfig& said = claimed.battery_gauge;
  Rig bench = WithoutCamerasAndImu(rig);
  bench.sensors.gimbals.clear();
  bench.sensors.barometer.reset();
  bench.sensors.position_reference.reset();
  bench.sensors.gnss.reset();
  bench.sensors.magnetometer.reset();
  bench.sensors.status_rate = {1, 60};
  bench.step = base::Seconds(claimed.battery_rate.Period());
  const auto record = [&](double volts, double amperes, std::vector<double>& voltage, std::vector<double>& current) {
    bench.battery = {volts, amperes};
    Record(bench, nullptr, Rest({}), base::Seconds(kSamples * claimed.battery_rate.Period()),
           [&](stack::Measurement&& m) {
             const auto* s = std::get_if<stack::BatterySample>(&m.data);
             if (s == nullptr) return;
             voltage.push_back(s->voltage);
             current.push_back(s->current);
           });
  };
  constexpr double kLow[] = {12.0, 2.0}, kHigh[] = {16.4, 42.0};  // V, A
  std::vector<double> low[2], high[2];
  record(kLow[0], kLow[1], low[0], low[1]);
  record(kHigh[0], kHigh[1], high[0], high[1]);
  const auto add = [&](int i, const std::string& what, double scale, double offset, double noise, double quantum,
                       const char* unit) {
    const double span = kHigh[i] - kLow[i];
    const double found = (SpreadOf(high[i]).mean - SpreadOf(low[i]).mean) / span - 1.0;
    // Without noise to dither it, rounding leaves half a quantum at each load.
    const double mean_error = kSigmas * noise / std::sqrt(kSamples) + (noise > quantum ? 0.0 : 0.5 * quantum) + 1e-9;
    report.Add(Compare(kBattery, what + " scale", scale, found, 2.0 * mean_error / span, "1"));
    report.Add(Compare(kBattery, what + " offset", offset, SpreadOf(low[i]).mean - (1.0 + found) * kLow[i],
                       mean_error * (1.0 + 2.0 * kLow[i] / span), unit));
    const double both = std::hypot(noise, quantum / std::sqrt(12.0));
    report.Add(Compare(kBattery, what + " noise and rounding, 1 sigma", both, SpreadOf(low[i]).sigma,
                       kSigmas * SigmaError(both, kSamples) + (noise > quantum ? 0.0 : both) + 1e-9, unit));
    if (quantum <= 0.0) return;
    // Readings are whole multiples: the largest distance from one, in quanta.
    double worst = 0.0;
    for (const double value : low[i]) worst = std::max(worst, std::abs(value / quantum - std::round(value / quantum)));
    report.Add(Compare(kBattery, what + ", distance from whole quanta", 0.0, worst, 1e-6, "1"));
  };
  add(0, "voltage", said.voltage_scale, said.voltage_offset, claimed.battery_noise, said.voltage_quantum, "V");
  add(1, "current", said.current_scale, said.current_offset, said.current_noise, said.current_quantum, "A");
}

}  // namespace alula::scenarios::check
