#pragma once

#include <string>

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

/// Smallest distance of the hull (body and propeller discs) to anything while in the air.
struct ClearanceConfig {
  double least = 0.0;            // m
  double airborne_height = 0.5;  // m above standing: lower is take-off or landing
  double reach = 5.0;            // m; farther is not measured
  base::Rate rate{50, 1};
};
void Describe(base::Description& d, ClearanceConfig& c);

class Clearance : public Criterion {
 public:
  explicit Clearance(const ClearanceConfig& config) : config_(config), smallest_(config.reach) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override { return {AtLeast("min_clearance", smallest_, config_.least, "m")}; }
  void AddMetrics(Metrics& metrics) const override { metrics["min_clearance_m"] = smallest_; }

 private:
  ClearanceConfig config_;
  double smallest_;
  std::int64_t next_ = 0;
};

}  // namespace alula::scenarios
