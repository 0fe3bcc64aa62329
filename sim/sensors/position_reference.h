#pragma once

#include <cstdint>
#include <string>

#include "base/describe.h"
#include "base/random.h"
#include "base/time.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// A motion-capture system as a vehicle meets it over a radio link.
struct PositionReferenceConfig {
  base::Rate rate{50, 1};
  double position_noise = 0.002;                  // 1σ per axis, m
  double attitude_noise = 0.0034906585039886592;  // 1σ per axis, rad (0.2 deg)
  base::Duration delay = base::Milliseconds(20);
};
void Describe(base::Description& d, PositionReferenceConfig& c);

class PositionReference {
 public:
  PositionReference(const PositionReferenceConfig& config, std::uint64_t seed, const std::string& name);
  stack::PositionFix Sample(const base::Transform& X_WB);

 private:
  PositionReferenceConfig config_;
  base::RandomStream stream_;
};

}  // namespace alula::sim
