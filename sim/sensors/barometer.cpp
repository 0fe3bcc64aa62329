#include "sim/sensors/barometer.h"

#include <cmath>

namespace alula::sim {

void Describe(base::Description& d, BarometerConfig& c) {
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "output rate"});
  d.Field("noise", c.noise, {.unit = "Pa", .meaning = "standard deviation of a sample", .min = 0});
  d.Field("weather_sigma", c.weather_sigma,
          {.unit = "Pa", .meaning = "standard deviation of the day's offset from the standard atmosphere", .min = 0});
}

double StandardPressure(double height) { return 101325.0 * std::pow(1.0 - 0.0065 * height / 288.15, 5.25588); }

Barometer::Barometer(const BarometerConfig& config, std::uint64_t seed, const std::string& name)
    : config_(config), stream_(seed, name), offset_(config.weather_sigma * stream_.Gaussian()) {}

stack::BaroSample Barometer::Sample(double height) {
  return {StandardPressure(height) + offset_ + config_.noise * stream_.Gaussian()};
}

}  // namespace alula::sim
