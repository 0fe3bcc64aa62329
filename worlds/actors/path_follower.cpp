#include "worlds/actors/path_follower.h"

#include <algorithm>
#include <cmath>

namespace alula::worlds {

double StoppingSpeed(double brake, double room) { return std::sqrt(2.0 * brake * std::max(room, 0.0)); }

double SpeedForPath(const RoundedPath& path, double s, const RunLimits& limits) {
  constexpr double kStep = 0.5;  // m
  const double reach = limits.speed * limits.speed / (2.0 * limits.brake) + kStep;
  double allowed = limits.speed;
  for (double ahead = 0.0; ahead <= reach; ahead += kStep) {
    const double curvature = std::abs(path.At(s + ahead).curvature);
    if (curvature < 1e-9) continue;
    const double bend = std::sqrt(limits.lateral / curvature);
    allowed = std::min(allowed, std::sqrt(bend * bend + 2.0 * limits.brake * ahead));
  }
  if (!path.closed()) allowed = std::min(allowed, StoppingSpeed(limits.brake, path.length() - s));
  return allowed;
}

double SpeedForPath(const RoundedPath& path, const Runner& runner, const RunLimits& limits) {
  return std::min(SpeedForPath(path, runner.s, limits), SpeedForPath(path, runner.s + kRunLag * runner.speed, limits));
}

void Run(Runner& runner, double wanted, const RunLimits& limits, double dt) {
  runner.acceleration =
      std::clamp((wanted - runner.speed) / std::max(kRunLag, dt), -2.0 * limits.brake, limits.accelerate);
  const double before = runner.speed;
  runner.speed = std::max(before + runner.acceleration * dt, 0.0);
  runner.s += 0.5 * (before + runner.speed) * dt;
}

}  // namespace alula::worlds
