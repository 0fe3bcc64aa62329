#pragma once

#include <cstdint>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "base/time.h"
#include "sim/ambience.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// Values of the class of an MS5611.
struct BarometerConfig {
  base::Rate rate{50, 1};
  double noise = 2.0;                             // 1σ, Pa: 17 cm of height
  double weather_sigma = 300.0;                   // 1σ of the day's pressure against the standard atmosphere, Pa
  double drift = 0.0;                             // 1σ of what wanders, Pa
  double drift_time = 300.0;                      // correlation time of it, s
  base::Vec3 wind_pressure = base::Vec3::Zero();  // share of ½ρv² along body x, y, z that the port takes as pressure
  double ground_pressure = 0.0;                   // share of the rotors' cushion near the ground, likewise
};
void Describe(base::Description& d, BarometerConfig& c);

/// Height (m) of the rotors above which their cushion does not reach the port; 0: it never does.
double GroundReach(const BarometerConfig& c);

/// Static pressure of the standard atmosphere (ISO 2533) plus the day's offset plus white noise, and what is switched
/// on of: drift, wind at the port, the cushion of air between rotors and ground.
///
///   p = p_ISO(h) + day + d + Σ_i c_i ½ρ v_i² + c_g (ΣT / ΣA) min(1, (R/4z)²) + n
///   d_{k+1} = a d_k + σ √(1 − a²) n,  a = e^(−1 / (rate · drift_time)),  in its stationary distribution from the start
///
/// v: through the air, body axes, ρ = 1.225 kg/m³; the form of PX4's EKF2_PCOEF_XP … Z (static pressure position
/// error), equal for both directions. ΣT / ΣA: disc loading; the cushion carries what thrust gains by the ground, which
/// is (R/4z)² of it (Cheeseman and Bennett 1955; vehicles/ground_effect.h).
class Barometer {
 public:
  Barometer(const BarometerConfig& config, std::uint64_t seed, const std::string& name);
  stack::BaroSample Sample(double height, const Ambience& ambience = {});

 private:
  BarometerConfig config_;
  base::RandomStream stream_, drift_stream_;
  double offset_;
  double drift_;  // Pa
};

/// p = 101325 (1 − 0.0065 h / 288.15)^5.25588, Pa.
double StandardPressure(double height);

}  // namespace alula::sim
