#pragma once

#include <optional>
#include <vector>

#include "base/describe.h"
#include "scenarios/criteria/criterion.h"

namespace alula::scenarios {

/// A crossing of a gate's plane by the body origin inside the opening, where the gate is at that time.
struct GatePassage {
  int gate = 0;
  base::Time time;
  bool forward = false;
  /// Room left between the opening's square and the hull, whose reach at the crossing erodes it; m, negative: outside.
  double margin = 0.0;
  double speed = 0.0;  // m/s
};

/// Follows the vehicle through the gates.
class GateTracker {
 public:
  /// The passage that ended in this step, if any.
  std::optional<GatePassage> Look(const sim::StepView& step);
  /// Gates passed in order and forward so far.
  int passed() const { return passed_; }
  bool done(const worlds::World& world) const { return passed_ >= static_cast<int>(world.gates.size()); }

 private:
  int passed_ = 0;
};

/// All gates in order and in the right direction, the hull inside the opening.
struct GatesConfig {
  double margin = 0.0;  // m that must be left between hull and opening
};
void Describe(base::Description& d, GatesConfig& c);

class Gates : public Criterion {
 public:
  explicit Gates(const GatesConfig& config) : config_(config) {}
  std::optional<std::string> Observe(const sim::StepView& step) override;
  std::vector<Check> Checks() const override;
  void AddMetrics(Metrics& metrics) const override;

 private:
  GatesConfig config_;
  GateTracker tracker_;
  int gates_ = 0;
  int wrong_ = 0;
  std::vector<GatePassage> passages_;
};

}  // namespace alula::scenarios
