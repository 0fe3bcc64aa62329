#pragma once

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"
#include "scenarios/criteria/gates.h"

namespace alula::scenarios {

/// Path length over time, from leaving the take-off column until the target is near and all gates are passed (or the
/// run ends).
struct MeanSpeedConfig {
  double least = 1.5;          // m/s
  double target_radius = 0.5;  // m
};
void Describe(base::Description& d, MeanSpeedConfig& c);

class MeanSpeed : public Criterion {
 public:
  explicit MeanSpeed(const MeanSpeedConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override;
  void AddMetrics(Metrics& metrics) const override;

 private:
  double Speed() const;

  MeanSpeedConfig config_;
  GateTracker tracker_;
  double path_ = 0.0;    // of the whole run, m
  double course_ = 0.0;  // m
  double fastest_ = 0.0;
  std::optional<base::Time> left_;
  base::Time last_;
  bool finished_ = false;
};

}  // namespace alula::scenarios
