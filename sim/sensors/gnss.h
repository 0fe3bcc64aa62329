#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/describe.h"
#include "base/random.h"
#include "base/time.h"

namespace alula::sim {

/// No fixes from `from` on, until `until`.
struct Outage {
  base::Duration from{}, until{};
};
void Describe(base::Description& d, Outage& c);

/// A position reference by satellites instead of motion capture. Defaults, chosen by us: a single-frequency receiver
/// under open sky.
struct GnssConfig {
  double horizontal = 1.0;         // 1σ per axis of the wandering error, m
  double vertical = 2.0;           // 1σ, m
  double correlation_time = 60.0;  // s
  double outage_rate = 0.0;        // outages that begin by chance, 1/s
  double outage_length = 5.0;      // their mean length, s
  std::vector<Outage> outages;     // besides those
};
void Describe(base::Description& d, GnssConfig& c);

/// Position error of first-order Gauss–Markov axes, e_{k+1} = a e_k + σ √(1 − a²) n, a = e^(−dt/τ), stationary from the
/// start, in the manner of Rankin 1994 ("An error model for sensor simulation: GPS and differential GPS"), who has
/// such processes in the pseudoranges: by axis of the position it is a simplification. Outages begin as a Poisson
/// process and last an exponentially distributed time.
class GnssErrors {
 public:
  /// Streams "<name>.gnss", "<name>.outages".
  GnssErrors(const GnssConfig& config, double period, std::uint64_t seed, const std::string& name);
  /// The error of the next fix, taken at t, m; none in an outage. One call a period.
  std::optional<base::Vec3> Next(base::Time t);

 private:
  GnssConfig config_;
  double period_, decay_;
  base::RandomStream stream_, outage_stream_;
  base::Vec3 sigma_, error_;
  double lost_for_ = 0.0;  // s, of an outage by chance
};

/// What a fix states as the standard deviation of an attitude that it does not measure, rad.
inline constexpr double kUnmeasuredAttitude = 1e3;

}  // namespace alula::sim
