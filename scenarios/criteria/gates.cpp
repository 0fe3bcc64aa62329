#include "scenarios/criteria/gates.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scenarios/criteria/hull.h"

namespace alula::scenarios {
namespace {

std::optional<GatePassage> Crossing(const worlds::Gate& gate, const sim::StepView& step) {
  const base::Transform X_GW = gate.X_WG.Inverse();
  const base::Vec3 before = X_GW * step.truth.at_begin.X_WB.p;
  const base::Vec3 after = X_GW * step.truth.at_end.X_WB.p;
  if ((before.x() < 0.0) == (after.x() < 0.0)) return std::nullopt;
  const base::Vec3 p_GB = before + (after - before) * (before.x() / (before.x() - after.x()));
  const double half = 0.5 * gate.opening;
  if (std::max(std::abs(p_GB.y()), std::abs(p_GB.z())) > half) return std::nullopt;

  GatePassage passage{.time = step.time, .forward = before.x() < 0.0, .speed = step.truth.at_end.v_WB.norm()};
  const base::Quat q_BG = step.truth.at_end.X_WB.q.conjugate() * gate.X_WG.q;
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
