#include "scenarios/criteria/gates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenarios/criteria/hull.h"
#include "sim/gate_crossing.h"

namespace alula::scenarios {
namespace {

std::optional<GatePassage> Crossing(const worlds::Gate& gate, const sim::StepView& step) {
  const std::optional<sim::GateCrossing> crossing = sim::CrossingOf(gate, step.actors, step.truth);
  if (!crossing) return std::nullopt;
  const base::Vec3& p_GB = crossing->p_GB;
  const double half = 0.5 * gate.opening;

  GatePassage passage{.time = step.time, .forward = crossing->forward, .speed = step.truth.at_end.v_WB.norm()};
  const base::Transform X_WG = step.actors.GatePose(gate, step.time);
  const base::Quat q_BG = step.truth.at_end.X_WB.q.conjugate() * X_WG.q;
  passage.margin = std::numeric_limits<double>::infinity();
  for (int axis = 1; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const base::Vec3 direction_B = q_BG * base::Vec3(sign * base::Vec3::Unit(axis));
      const double reach = sign * p_GB[axis] + HullReach(step.vehicle.body(), direction_B);
      passage.margin = std::min(passage.margin, half - reach);
    }
  }
  return passage;
}

}  // namespace

std::optional<GatePassage> GateTracker::Look(const sim::StepView& step) {
  for (std::size_t i = 0; i < step.world.gates.size(); ++i) {
    std::optional<GatePassage> passage = Crossing(step.world.gates[i], step);
    if (!passage) continue;
    passage->gate = static_cast<int>(i);
    if (passage->forward && passage->gate == passed_) ++passed_;
    return passage;
  }
  return std::nullopt;
}

void Describe(base::Description& d, GatesConfig& c) {
  d.Field("margin", c.margin, {.unit = "m", .meaning = "room that must be left between hull and opening"});
}

std::optional<std::string> Gates::Observe(const sim::StepView& step) {
  gates_ = static_cast<int>(step.world.gates.size());
  const int before = tracker_.passed();
  if (const std::optional<GatePassage> passage = tracker_.Look(step)) {
    if (tracker_.passed() > before) {
      passages_.push_back(*passage);
    } else {
      ++wrong_;
    }
  }
  return std::nullopt;
}

std::vector<Check> Gates::Checks() const {
  double margin = passages_.empty() ? 0.0 : std::numeric_limits<double>::infinity();
  for (const GatePassage& passage : passages_) margin = std::min(margin, passage.margin);
  return {AtLeast("gates_passed", tracker_.passed(), gates_, "1"), AtMost("wrong_gate_passages", wrong_, 0, "1"),
          AtLeast("gate_margin", margin, config_.margin, "m")};
}

void Gates::AddMetrics(Metrics& metrics) const {
  for (const GatePassage& passage : passages_) {
    const std::string prefix = "gate" + std::to_string(passage.gate);
    metrics[prefix + "_time_s"] = passage.time.Seconds();
    metrics[prefix + "_margin_m"] = passage.margin;
    metrics[prefix + "_speed_m_s"] = passage.speed;
  }
}

}  // namespace alula::scenarios
