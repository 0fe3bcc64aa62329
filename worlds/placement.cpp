#include "worlds/placement.h"

#include <algorithm>
#include <cmath>

namespace alula::worlds {
namespace {

using base::Vec2;

bool IsClearOfGate(const Footprint& thing, const GatePlan& gate) {
  const Vec2 along(std::cos(gate.yaw), std::sin(gate.yaw));
  const Vec2 across(-along.y(), along.x());
  const double room =
      DistanceToSegment(thing.centre, gate.p - kGateFreeLength * along, gate.p + kGateFreeLength * along);
  const double outer = 0.5 * gate.opening + gate.frame;
  const double bars = DistanceToSegment(thing.centre, gate.p - outer * across, gate.p + outer * across);
  return room >= kGateFreeRadius + 0.05 + thing.radius && bars >= kPassableWidth + 0.5 * gate.frame + thing.radius;
}

}  // namespace

bool Placement::IsFree(const Footprint& thing, bool at_wall) const {
  const double wall_gap = at_wall ? 0.0 : kPassableWidth;
  if (std::abs(thing.centre.x()) + thing.radius + wall_gap > kCourtyardHalfLength) return false;
  if (std::abs(thing.centre.y()) + thing.radius + wall_gap > kCourtyardHalfWidth) return false;
  for (const GatePlan& gate : course_.gates) {
    if (!IsClearOfGate(thing, gate)) return false;
  }
  const GatePlan& first = course_.gates.front();
  const GatePlan& last = course_.gates.back();
  if ((thing.centre - course_.pad).norm() < 2.2 + thing.radius) return false;
  if ((thing.centre - course_.target).norm() < 1.5 + thing.radius) return false;
  if (DistanceToSegment(thing.centre, course_.pad, first.p) < 1.0 + thing.radius) return false;
  if (DistanceToSegment(thing.centre, last.p, course_.target) < 1.0 + thing.radius) return false;
  return std::all_of(taken_.begin(), taken_.end(), [&](const Footprint& other) {
    return (thing.centre - other.centre).norm() >= thing.radius + other.radius + kPassableWidth;
  });
}

}  // namespace alula::worlds
