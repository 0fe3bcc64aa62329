#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "base/time.h"
#include "sim/sensors/gnss.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// A motion-capture system as a vehicle meets it over a radio link, or satellites (`gnss`).
struct PositionReferenceConfig {
  base::Rate rate{50, 1};
  double position_noise = 0.002;                  // 1σ per axis, m
  double attitude_noise = 0.0034906585039886592;  // 1σ per axis, rad (0.2 deg)
  base::Duration delay = base::Milliseconds(20);
  std::optional<GnssConfig> gnss{};  // satellites: the position wanders and may be lost, attitude is not measured
};
void Describe(base::Description& d, PositionReferenceConfig& c);

/// A receiver of satellites that flies along, besides whatever else tells the position. Defaults, chosen by us:
/// a single-frequency receiver under open sky.
struct GnssReceiverConfig : GnssConfig {
  base::Rate rate{5, 1};
  double noise = 0.1;  // 1σ per axis of what differs from fix to fix, m
  base::Duration delay = base::Milliseconds(120);
};
void Describe(base::Description& d, GnssReceiverConfig& c);

/// The position reference that a receiver is.
PositionReferenceConfig ReferenceOf(const GnssReceiverConfig& receiver);

class PositionReference {
 public:
  PositionReference(const PositionReferenceConfig& config, std::uint64_t seed, const std::string& name);
  /// The fix of time t, none in an outage. Of satellites: no rotation, attitude_sigma kUnmeasuredAttitude, and a
  /// position_sigma of noise and wandering error together (root mean square over the axes).
  std::optional<stack::PositionFix> Sample(base::Time t, const base::Transform& X_WB);

 private:
  PositionReferenceConfig config_;
  base::RandomStream stream_;
  std::optional<GnssErrors> gnss_;
};

}  // namespace alula::sim
