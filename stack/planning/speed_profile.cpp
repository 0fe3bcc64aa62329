#include "stack/planning/speed_profile.h"

#include <algorithm>
#include <cmath>

namespace alula::stack::planning {

namespace {

constexpr double kStep = 0.02;            // m of arc length
constexpr double kHeadingReserve = 0.85;  // share of the yaw rate that the path's turning may use

/// Squared speed allowed at s by the curve's shape and the zones.
double AllowedSquared(const Curve& curve, double s, const std::vector<SpeedZone>& zones, const TrajectoryLimits& limits,
                      double scale, double decayed_start) {
  double speed = limits.max_speed;
  for (const SpeedZone& zone : zones) {
    if (s >= zone.from && s <= zone.to) speed = std::min(speed, zone.speed);
  }
  const double climb = std::abs(curve.Tangent(s).z());
  if (climb > 1e-6) speed = std::min(speed, limits.max_climb_speed / climb);
  const double turning = curve.HorizontalCurvature(s);
  if (turning > 1e-6) speed = std::min(speed, kHeadingReserve * limits.max_yaw_rate / turning);
  const double soft = std::max(speed * speed, decayed_start);
  const double curvature = curve.Curvature(s);
  const double lateral = scale * limits.lateral_share * limits.max_acceleration;
  return curvature > 1e-6 ? std::min(soft, lateral / curvature) : soft;
}

/// Tangential acceleration left over beside the lateral one.
double TangentialLimit(double curvature, double squared_speed, double max_acceleration) {
  const double lateral = std::min(curvature * squared_speed, 0.8 * max_acceleration);
  return std::sqrt(max_acceleration * max_acceleration - lateral * lateral);
}

}  // namespace

double SpeedProfile::At(double time) const {
  if (time <= 0.0) return s.front();
  if (time >= t.back()) return s.back();
  const auto i = static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin()) - 1;
  const double span = t[i + 1] - t[i];
  const double x = time - t[i];
  const double acceleration = span > 1e-9 ? (v[i + 1] - v[i]) / span : 0.0;
  return std::min(s[i] + v[i] * x + 0.5 * acceleration * x * x, s[i + 1]);
}

std::optional<SpeedProfile> MakeSpeedProfile(const Curve& curve, double stop_at, double start_speed, double end_speed,
                                             const std::vector<SpeedZone>& zones, const TrajectoryLimits& limits,
                                             double brake_scale) {
  const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(stop_at / kStep)));
  const double step = stop_at / static_cast<double>(count);
  const double acceleration = brake_scale * limits.max_acceleration;
  const double start_squared = start_speed * start_speed;
  std::vector<double> squared(count + 1);
  std::vector<double> curvature(count + 1);
  for (std::size_t i = 0; i <= count; ++i) {
    const double s = step * static_cast<double>(i);
    // A start faster than its zone may come down gently.
    const double decayed = start_squared - limits.max_acceleration * s;
    squared[i] = AllowedSquared(curve, s, zones, limits, brake_scale, decayed);
    curvature[i] = curve.Curvature(s);
  }
  squared[count] = std::min(squared[count], end_speed * end_speed);
  for (std::size_t i = count; i-- > 0;) {
    const double a = TangentialLimit(curvature[i], squared[i + 1], acceleration);
    squared[i] = std::min(squared[i], squared[i + 1] + 2.0 * a * step);
  }
  if (start_squared > squared[0] + 1e-3) return std::nullopt;
  squared[0] = start_squared;
  for (std::size_t i = 1; i <= count; ++i) {
    const double a = TangentialLimit(curvature[i - 1], squared[i - 1], limits.max_acceleration);
    squared[i] = std::min(squared[i], squared[i - 1] + 2.0 * a * step);
  }
  SpeedProfile profile;
  profile.s.resize(count + 1);
  profile.v.resize(count + 1);
  profile.t.assign(count + 1, 0.0);
  for (std::size_t i = 0; i <= count; ++i) {
    profile.s[i] = step * static_cast<double>(i);
    profile.v[i] = std::sqrt(std::max(squared[i], 0.0));
    if (i > 0) profile.t[i] = profile.t[i - 1] + 2.0 * step / std::max(profile.v[i] + profile.v[i - 1], 1e-3);
  }
  return profile;
}

}  // namespace alula::stack::planning
