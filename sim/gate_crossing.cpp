#include "sim/gate_crossing.h"

#include <algorithm>
#include <cmath>

namespace alula::sim {

std::optional<GateCrossing> CrossingOf(const worlds::Gate& gate, const worlds::ActorSimulation& actors,
                                       const TruthWindow& truth) {
  const base::Vec3 before = actors.GatePose(gate, truth.begin).Inverse() * truth.at_begin.X_WB.p;
  const base::Vec3 after = actors.GatePose(gate, truth.end).Inverse() * truth.at_end.X_WB.p;
  if ((before.x() < 0.0) == (after.x() < 0.0)) return std::nullopt;
  const base::Vec3 p_GB = before + (after - before) * (before.x() / (before.x() - after.x()));
  if (std::max(std::abs(p_GB.y()), std::abs(p_GB.z())) > 0.5 * gate.opening) return std::nullopt;
  return GateCrossing{p_GB, before.x() < 0.0};
}

}  // namespace alula::sim
