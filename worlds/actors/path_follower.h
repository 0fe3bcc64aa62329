#pragma once

#include "worlds/actors/path.h"
#include "worlds/actors/surroundings.h"

namespace alula::worlds {

/// Something that runs along a path: how far it has come, how fast it goes, how it speeds up.
struct Runner {
  double s = 0.0;             // m along the path
  double speed = 0.0;         // m/s
  double acceleration = 0.0;  // m/s²
};

/// How a thing may run.
struct RunLimits {
  double speed = 5.0;       // m/s
  double accelerate = 1.5;  // m/s²
  double brake = 2.5;       // m/s², as it likes to; twice as much where it must
  double lateral = 2.0;     // m/s², in bends
};

/// Speed at which one can still stop within `room` m, √(2 b room).
double StoppingSpeed(double brake, double room);

/// Speed that the bends ahead allow at s: every point at distance d ahead allows √(v² + 2 b d) with v = √(lateral /
/// |curvature|), and the end of an open path v = 0.
double SpeedForPath(const RoundedPath& path, double s, const RunLimits& limits);
/// The same for a runner, who is a lag late.
double SpeedForPath(const RoundedPath& path, const Runner& runner, const RunLimits& limits);

/// One tick towards the speed `wanted`, which is followed with a lag of kRunLag; who must slow down looks that far
/// ahead.
inline constexpr double kRunLag = 0.2;  // s
void Run(Runner& runner, double wanted, const RunLimits& limits, double dt);

}  // namespace alula::worlds
