#include "worlds/actors/social_force.h"

#include <algorithm>
#include <cmath>

namespace alula::worlds {

using base::Vec2;

Vec2 DrivingForce(const Vec2& v_wish, const Vec2& v) {
  constexpr double kRelaxation = 0.5;  // s
  return (v_wish - v) / kRelaxation;
}

Vec2 BodyForce(const Repulsion& repulsion, const Vec2& r, const Vec2& v_other, const Vec2& facing) {
  constexpr double kStride = 2.0;      // s, that people look ahead
  constexpr double kBehind = 0.5;      // weight of what is not seen
  constexpr double kSeen = -0.173648;  // cos 100°
  const Vec2 stride = kStride * v_other;
  const double r1 = std::max(r.norm(), 1e-3);
  const Vec2 to_end = r - stride;
  const double r2 = std::max(to_end.norm(), 1e-3);
  const double b = std::max(0.5 * std::sqrt(std::max((r1 + r2) * (r1 + r2) - stride.squaredNorm(), 0.0)), 0.05);
  const Vec2 gradient_b = (r1 + r2) / (4.0 * b) * (r / r1 + to_end / r2);
  const Vec2 force = repulsion.strength / repulsion.range * std::exp(-b / repulsion.range) * gradient_b;
  const bool seen = facing.dot(-r) >= kSeen * r1;
  return seen ? force : Vec2(kBehind * force);
}

Vec2 BorderForce(const Gap& gap) {
  constexpr double kStrength = 5.0;  // m²/s²
  constexpr double kRange = 0.1;     // m
  return kStrength / kRange * std::exp(-std::max(gap.distance, 0.0) / kRange) * gap.away;
}

}  // namespace alula::worlds
