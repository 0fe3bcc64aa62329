#include "sim/sensors/barometer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace alula::sim {
namespace {

constexpr double kAirDensity = 1.225;  // kg/m³, ISO 2533 at sea level
constexpr double kCushionReach = 2.0;  // m: there a disc of 0.3 m radius has 0.14 % of its loading left

/// Disc loading times (R/4z)², Pa.
double CushionPressure(const Ambience& ambience) {
  if (!std::isfinite(ambience.rotor_height)) return 0.0;
  double thrust = 0.0, area = 0.0, radius = 0.0;
  for (const vehicles::RotorState& rotor : ambience.rotors) {
    thrust += rotor.thrust;
    area += std::numbers::pi * rotor.radius * rotor.radius;
    radius = std::max(radius, rotor.radius);
  }
  if (area <= 0.0) return 0.0;
  const double ratio = radius / (4.0 * std::max(ambience.rotor_height, 0.25 * radius));
  return thrust / area * ratio * ratio;
}

}  // namespace

void Describe(base::Description& d, BarometerConfig& c) {
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "output rate"});
  d.Field("noise", c.noise, {.unit = "Pa", .meaning = "standard deviation of a sample", .min = 0});
  d.Field("weather_sigma", c.weather_sigma,
          {.unit = "Pa", .meaning = "standard deviation of the day's offset from the standard atmosphere", .min = 0});
  d.Field("drift", c.drift, {.unit = "Pa", .meaning = "standard deviation of what wanders", .min = 0});
  d.Field("drift_time", c.drift_time, {.unit = "s", .meaning = "correlation time of the drift", .min = 0.1});
  d.Field("wind_pressure", c.wind_pressure,
          {.meaning = "share of the dynamic pressure along body x, y and z in the reading", .min = -2, .max = 2});
  d.Field("ground_pressure", c.ground_pressure,
          {.meaning = "share in the reading of the rotors' cushion near the ground", .min = -5, .max = 5});
}

double GroundReach(const BarometerConfig& c) { return c.ground_pressure != 0.0 ? kCushionReach : 0.0; }

double StandardPressure(double height) { return 101325.0 * std::pow(1.0 - 0.0065 * height / 288.15, 5.25588); }

Barometer::Barometer(const BarometerConfig& config, std::uint64_t seed, const std::string& name)
    : config_(config),
      stream_(seed, name),
      drift_stream_(seed, name + ".drift"),
      offset_(config.weather_sigma * stream_.Gaussian()),
      drift_(config.drift * drift_stream_.Gaussian()) {}

stack::BaroSample Barometer::Sample(double height, const Ambience& ambience) {
  double pressure = StandardPressure(height) + offset_ + config_.noise * stream_.Gaussian();
  if (config_.drift > 0.0) {
    pressure += drift_;
    const double decay = std::exp(-config_.rate.Period() / config_.drift_time);
    drift_ = decay * drift_ + config_.drift * std::sqrt(1.0 - decay * decay) * drift_stream_.Gaussian();
  }
  if (!config_.wind_pressure.isZero()) {
    pressure += 0.5 * kAirDensity * config_.wind_pressure.dot(ambience.v_air_B.cwiseAbs2());
  }
  if (config_.ground_pressure != 0.0) pressure += config_.ground_pressure * CushionPressure(ambience);
  return {pressure};
}

}  // namespace alula::sim
