#pragma once

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"
#include "scenarios/criteria/gates.h"

namespace alula::scenarios {

/// All gates passed, then near the target and slow for a while.
struct TargetReachedConfig {
  double radius = 0.5;  // m
  double speed = 0.5;   // m/s
  base::Duration dwell = base::Milliseconds(500);
  bool ends_run = true;
};
void Describe(base::Description& d, TargetReachedConfig& c);

class TargetReached : public Criterion {
 public:
  explicit TargetReached(const TargetReachedConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override;
  void AddMetrics(Metrics& metrics) const override { metrics["target_distance_m"] = distance_; }

 private:
  TargetReachedConfig config_;
  GateTracker tracker_;
  double distance_ = 0.0;  // now, m
  bool gates_done_ = false;
  std::optional<base::Time> since_;
  bool reached_ = false;
};

}  // namespace alula::scenarios
