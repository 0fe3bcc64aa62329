#pragma once

#include <string>
#include <vector>

#include "base/describe.h"
#include "stack/estimation/odometry.h"

namespace alula::stack::estimation {

/// What of an IMU's reading in an interval cannot be believed.
struct Saturation {
  bool gyro = false, accel = false;
  bool any() const { return gyro || accel; }
};
Saturation SaturationOf(const std::vector<TimedImu>& samples, const ImuNoise& range, double share);

/// Samples that are numbers and newer than `after` and each other; says in `complaint` what was left out.
std::vector<TimedImu> Sound(const std::vector<TimedImu>& samples, base::Time after, std::string& complaint);

/// The same pixels twice: noise makes that impossible for a camera that works, but one without noise that does not
/// move.
bool Repeats(const Image& a, const Image& b);

/// Turn between two samples' times, rad.
double TurnOf(const std::vector<TimedImu>& samples, const base::Vec3& gyro_bias);

/// Remembers whether images and gyroscope agree on how the camera turned.
class TurnWatch {
 public:
  /// `by_turn` of `points` agree with the gyroscope's turn, `by_pose` with some pose. False: too often too few did.
  bool Agree(int points, int by_turn, int by_pose);
  void Restart() { strikes_ = 0; }

 private:
  int strikes_ = 0;
};

}  // namespace alula::stack::estimation
