#pragma once

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

/// The body origin stays inside the world's bounds.
struct BoundsConfig {
  double margin = 0.0;  // m outside that are forgiven
  bool ends_run = true;
};
void Describe(base::Description& d, BoundsConfig& c);

class Bounds : public Criterion {
 public:
  explicit Bounds(const BoundsConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override { return {AtMost("out_of_bounds", farthest_, config_.margin, "m")}; }

 private:
  BoundsConfig config_;
  double farthest_ = 0.0;  // outside, m
};

}  // namespace alula::scenarios
