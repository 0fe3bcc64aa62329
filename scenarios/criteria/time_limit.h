#pragma once

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

struct TimeLimitConfig {
  base::Duration limit = base::Seconds(120.0);
};
void Describe(base::Description& d, TimeLimitConfig& c);

/// Ends the run when it lasts too long.
class TimeLimit : public Criterion {
 public:
  explicit TimeLimit(const TimeLimitConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override;
  void AddMetrics(Metrics& metrics) const override { metrics["duration_s"] = last_.Seconds(); }

 private:
  TimeLimitConfig config_;
  base::Time last_;
};

}  // namespace alula::scenarios
