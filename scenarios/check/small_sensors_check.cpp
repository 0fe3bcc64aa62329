#include "scenarios/check/small_sensors_check.h"

#include <cmath>

#include "scenarios/check/statistics.h"

namespace alula::scenarios::check {
namespace {

constexpr double kSamples = 4000.0;  // sigma to 1.1 %, so that a tolerance of four errors is 4.5 %

/// What one kind of sensor says.
template <typename Sample>
std::vector<std::pair<stack::Measurement, Sample>> RecordSamples(const Rig& rig, const base::Transform& X_WB,
                                                                 base::Rate rate, double samples) {
  std::vector<std::pair<stack::Measurement, Sample>> all;
  Rig bench = WithoutCamerasAndImu(rig);
  bench.sensors.gimbals.clear();
  Record(bench, nullptr, Rest(X_WB), base::Seconds(samples * rate.Period()), [&all](stack::Measurement&& m) {
    if (const auto* sample = std::get_if<Sample>(&m.data)) all.emplace_back(m, *sample);
  });
  return all;
}

template <typename Sample>
void AddRate(const char* name, base::Rate rate, const std::vector<std::pair<stack::Measurement, Sample>>& all,
             Report& report) {
  const double span = (all.back().first.captured - all.front().first.captured).Seconds();
  report.Add(Compare(name, "rate", rate.Hz(), (static_cast<double>(all.size()) - 1.0) / span, 1e-6 * rate.Hz(), "Hz"));
}

void AddSigma(const char* name, const char* quantity, double configured, const std::vector<double>& samples,
              const char* unit, Report& report) {
  report.Add(Compare(name, quantity, configured, SpreadOf(samples).sigma,
                     kSigmas * SigmaError(configured, static_cast<double>(samples.size())) + 1e-12, unit));
}

std::vector<double> Pressures(const Rig& rig, base::Rate rate, double height, double samples) {
  std::vector<double> pressures;
  for (const auto& [m, sample] :
       RecordSamples<stack::BaroSample>(rig, {base::Quat::Identity(), {0, 0, height}}, rate, samples)) {
    pressures.push_back(sample.pressure);
  }
  return pressures;
}

}  // namespace

void CheckBarometer(const Rig& rig, const sim::BarometerConfig& claimed, Report& report) {
  constexpr const char* kName = "vehicle0/barometer";
  const auto rest = RecordSamples<stack::BaroSample>(rig, {}, claimed.rate, kSamples);
  AddRate(kName, claimed.rate, rest, report);
  std::vector<double> low;
  for (const auto& [m, sample] : rest) low.push_back(sample.pressure);
  AddSigma(kName, "noise, 1 sigma", claimed.noise, low, "Pa", report);
  // ISO 2533 near the ground: 101325 Pa · 5.25588 · 0.0065 K/m / 288.15 K = 12.013 Pa/m, 0.21 Pa less over 40 m.
  const Spread at_ground = SpreadOf(low), above = SpreadOf(Pressures(rig, claimed.rate, 40.0, kSamples));
  report.Add(Compare(kName, "pressure's fall over 40 m",
                     101325.0 - 101325.0 * std::pow(1.0 - 0.0065 * 40.0 / 288.15, 5.25588), at_ground.mean - above.mean,
                     kSigmas * claimed.noise * std::sqrt(2.0 / kSamples) + 1e-9, "Pa"));
  constexpr int kSeeds = 400;
  std::vector<double> offsets;
  for (int i = 0; i < kSeeds; ++i) {
    Rig one = rig;
    one.seed = rig.seed + static_cast<std::uint64_t>(i);
    offsets.push_back(Pressures(one, claimed.rate, 0.0, 1.0).front());
  }
  const double both = std::hypot(claimed.weather_sigma, claimed.noise);
  report.Add(Compare(kName, "day's offset and noise, 1 sigma", both, SpreadOf(offsets).sigma,
                     kSigmas * SigmaError(both, kSeeds) + 1e-9, "Pa"));
}

void CheckPositionReference(const Rig& rig, const sim::PositionReferenceConfig& claimed, Report& report) {
  constexpr const char* kName = "vehicle0/position_reference";
  const base::Transform X_WB{base::FromYawPitchRoll(0.4, 0.1, -0.2), {1.0, -2.0, 3.0}};
  Rig bench = rig;
  bench.sensors.gnss.reset();
  const auto rest = RecordSamples<stack::PositionFix>(bench, X_WB, claimed.rate, kSamples);
  AddRate(kName, claimed.rate, rest, report);
  std::vector<double> positions, angles, delays;
  for (const auto& [m, fix] : rest) {
    const base::Vec3 dp = fix.X_WB.p - X_WB.p, dtheta = base::Log(X_WB.q.conjugate() * fix.X_WB.q);
    for (int i = 0; i < 3; ++i) {
      positions.push_back(dp[i]);
      angles.push_back(dtheta[i] / kDegree);
    }
    delays.push_back((m.available - m.captured).Seconds());
  }
  AddSigma(kName, "position noise, 1 sigma", claimed.position_noise, positions, "m", report);
  AddSigma(kName, "attitude noise, 1 sigma", claimed.attitude_noise / kDegree, angles, "deg", report);
  report.Add(Compare(kName, "position bias", 0.0, SpreadOf(positions).mean,
                     kSigmas * claimed.position_noise / std::sqrt(3.0 * kSamples) + 1e-12, "m"));
  report.Add(Compare(kName, "delay", claimed.delay.Seconds(), SpreadOf(delays).mean, 1e-9, "s"));
}

void CheckGnssReceiver(const Rig& rig, const sim::GnssReceiverConfig& claimed, Report& report) {
  constexpr const char* kName = "vehicle0/gnss";
  Rig bench = rig;
  bench.sensors.position_reference.reset();
  const auto rest = RecordSamples<stack::PositionFix>(bench, {}, claimed.rate, kSamples);
  AddRate(kName, claimed.rate, rest, report);
  std::vector<double> positions, delays;
  for (const auto& [m, fix] : rest) {
    for (int i = 0; i < 3; ++i) positions.push_back(fix.X_WB.p[i]);
    delays.push_back((m.available - m.captured).Seconds());
  }
  AddSigma(kName, "noise, 1 sigma", claimed.noise, positions, "m", report);
  report.Add(Compare(kName, "delay", claimed.delay.Seconds(), SpreadOf(delays).mean, 1e-9, "s"));
}

void CheckBattery(const Rig& rig, const sim::SensorsConfig& claimed, Report& report) {
  constexpr const char* kName = "vehicle0/battery";
  const auto rest = RecordSamples<stack::BatterySample>(rig, {}, claimed.battery_rate, kSamples);
  AddRate(kName, claimed.battery_rate, rest, report);
  std::vector<double> volts;
  for (const auto& [m, sample] : rest) volts.push_back(sample.voltage);
  AddSigma(kName, "noise, 1 sigma", claimed.battery_noise, volts, "V", report);
}

}  // namespace alula::scenarios::check
