#pragma once

#include <cstdint>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "base/time.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// Values of the class of an MS5611.
struct BarometerConfig {
  base::Rate rate{50, 1};
  double noise = 2.0;            // 1σ, Pa: 17 cm of height
  double weather_sigma = 300.0;  // 1σ of the day's pressure against the standard atmosphere, Pa
};
void Describe(base::Description& d, BarometerConfig& c);

/// Static pressure of the standard atmosphere (ISO 2533) plus the day's offset plus white noise.
class Barometer {
 public:
  Barometer(const BarometerConfig& config, std::uint64_t seed, const std::string& name);
  stack::BaroSample Sample(double height);

 private:
  BarometerConfig config_;
  base::RandomStream stream_;
  double offset_;
};

/// p = 101325 (1 − 0.0065 h / 288.15)^5.25588, Pa.
double StandardPressure(double height);

}  // namespace alula::sim
