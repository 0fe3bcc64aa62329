#include "scenarios/criteria/time_limit.h"

namespace alula::scenarios {

void Describe(base::Description& d, TimeLimitConfig& c) {
  d.Field("limit", c.limit, {.unit = "s", .meaning = "the run must end before"});
}

std::optional<std::string> TimeLimit::Observe(const sim::StepView& step) {
  last_ = step.time;
  if (step.time.ns >= config_.limit.ns) return "time_limit";
  return std::nullopt;
}

std::vector<Check> TimeLimit::Checks() const {
  Check check = AtMost("duration", last_.Seconds(), config_.limit.Seconds(), "s");
  check.passed = last_.ns < config_.limit.ns;
  check.relation = "<";
  return {check};
}

}  // namespace alula::scenarios
