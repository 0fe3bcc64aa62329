#include "scenarios/criteria/bounds.h"

#include <algorithm>

namespace alula::scenarios {

void Describe(base::Description& d, BoundsConfig& c) {
  d.Field("margin", c.margin, {.unit = "m", .meaning = "outside the world's bounds that is forgiven", .min = 0});
  d.Field("ends_run", c.ends_run, {.meaning = "whether leaving the bounds ends the run"});
}

std::optional<std::string> Bounds::Observe(const sim::StepView& step) {
  const base::Vec3& p_WB = step.truth.at_end.X_WB.p;
  const double outside =
      (step.world.bounds_low - p_WB).cwiseMax(p_WB - step.world.bounds_high).cwiseMax(0.0).maxCoeff();
  farthest_ = std::max(farthest_, outside);
  if (outside > config_.margin && config_.ends_run) return "out_of_bounds";
  return std::nullopt;
}

}  // namespace alula::scenarios
