#pragma once

#include "sim/observer.h"

namespace alula::scenarios {

/// Ends a run that its stack has given up or finished: "stack_done" once it is done and the vehicle disarmed,
/// "stack_failed" some seconds after it failed (so that the autopilot's landing is seen).
class EndOfStack : public sim::Observer {
 public:
  std::optional<std::string> Observe(const sim::StepView& step) override {
    if (step.output == nullptr) return std::nullopt;
    const bool over = step.output->state == stack::StackState::kDone && !step.status.armed;
    const bool failed = step.output->state == stack::StackState::kFailed;
    if (!over && !failed) since_.reset();
    if ((over || failed) && !since_) since_ = step.time;
    if (over && step.time - *since_ >= kAfterDone) return "stack_done";
    if (failed && step.time - *since_ >= kAfterFailure) return "stack_failed";
    return std::nullopt;
  }

 private:
  static constexpr base::Duration kAfterDone = base::Seconds(2.0);
  static constexpr base::Duration kAfterFailure = base::Seconds(8.0);
  std::optional<base::Time> since_;
};

}  // namespace alula::scenarios
