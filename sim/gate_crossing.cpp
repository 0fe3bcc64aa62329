#include "sim/gate_crossing.h"

#include <algorithm>
#include <cmath>

namespace alula::sim {

std::optional<GateCrossing> CrossingOf(const worlds::Gate& gate, const TruthWindow& truth) {
  const base::Transform X_GW = gate.X_WG.Inverse();
  const base::Vec3 before = X_GW * truth.at_begin.X_WB.p;
  const base::Vec3 after = X_GW * truth.at_end.X_WB.p;
  if ((before.x() < 0.0) == (after.x() < 0.0)) return std::nullopt;
  const base::Vec3 p_GB = before + (after - before) * (before.x() / (before.x() - after.x()));
  if (std::max(std::abs(p_GB.y()), std::abs(p_GB.z())) > 0.5 * gate.opening) return std::nullopt;
  return GateCrossing{p_GB, before.x() < 0.0};
}

}  // namespace alula::sim
