#pragma once

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

/// How well a point is held: distance to it over a window that begins some time after the vehicle came near.
struct HoverErrorConfig {
  base::Vec3 point{0.0, 0.0, 1.5};  // of the body origin, from where it stood at the start, world axes, m
  double arrival_radius = 0.3;      // m
  base::Duration settle = base::Seconds(2.0);
  base::Duration window = base::Seconds(8.0);
  double rms = 0.05;      // m
  double largest = 0.15;  // m
};
void Describe(base::Description& d, HoverErrorConfig& c);

class HoverError : public Criterion {
 public:
  explicit HoverError(const HoverErrorConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override;

 private:
  HoverErrorConfig config_;
  std::optional<base::Time> arrived_;
  bool complete_ = false;
  double sum_squares_ = 0.0;
  double largest_ = 0.0;
  std::int64_t samples_ = 0;
};

}  // namespace alula::scenarios
