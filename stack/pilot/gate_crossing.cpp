#include "stack/pilot/gate_crossing.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::pilot {

namespace {

constexpr double kBeside = 2.0;        // m off the axis up to which a crossing of the plane is about this gate
constexpr double kViewRadius = 1.0;    // m off the axis
constexpr double kViewAfter = 0.5;     // m after the plane
constexpr double kCorridorEnd = 0.15;  // m before the end of the straight flight that count as its end
constexpr double kCorridorFar = 3.0;   // m from the gate

}  // namespace

double OffAxis(const base::Vec3& p_G) { return std::max(std::abs(p_G.y()), std::abs(p_G.z())); }

Crossing CrossingOf(const base::Vec3& before_G, const base::Vec3& p_G, double opening) {
  const double off = OffAxis(p_G);
  if (!(before_G.x() < 0.0 && p_G.x() >= 0.0) || off > kBeside) return Crossing::kNone;
  return off > 0.5 * opening ? Crossing::kBeside : Crossing::kThrough;
}

bool FrameLeavesView(const base::Vec3& p_G, double freeze_distance) {
  return p_G.x() > -freeze_distance && p_G.x() < kViewAfter && OffAxis(p_G) < kViewRadius;
}

bool CorridorLeft(const base::Vec3& p_G, double passage_after) {
  return p_G.x() > passage_after - kCorridorEnd || p_G.norm() > kCorridorFar;
}

}  // namespace alula::stack::pilot
