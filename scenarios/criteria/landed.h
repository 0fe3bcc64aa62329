#pragma once

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

/// Was in the air, then rests on its legs on the pad with the rotors off.
struct LandedConfig {
  double airborne_height = 0.5;  // m above the pad, that counts as having flown
  double rest_speed = 0.05;      // m/s
  base::Duration rest = base::Milliseconds(500);
  bool ends_run = true;
};
void Describe(base::Description& d, LandedConfig& c);

class Landed : public Criterion {
 public:
  explicit Landed(const LandedConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override { return {AtLeast("landed", landed_ ? 1.0 : 0.0, 1.0, "1")}; }
  void AddMetrics(Metrics& metrics) const override { metrics["landing_offset_m"] = offset_; }

 private:
  LandedConfig config_;
  bool flew_ = false;
  bool landed_ = false;
  double offset_ = 0.0;  // horizontal, from the start, m
  std::optional<base::Time> since_;
};

}  // namespace alula::scenarios
