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

/// Remembers whether what is seen fits how the body is thought to have moved. Points that have just begun always fit,
/// so one image alone says little.
class MotionWatch {
 public:
  enum class Verdict { kFits, kTurnsOtherwise, kFitsNothing };

  /// Of `points` that were known before, `by_turn` agree with the gyroscope's turn and some translation, `by_pose` with
  /// some pose.
  Verdict Update(int points, int by_turn, int by_pose);
  void Restart() { *this = {}; }

 private:
  double by_turn_ = 1.0, by_pose_ = 1.0;  // shares of the points, of late
  int misfits_ = 0;                       // images in a row
};

}  // namespace alula::stack::estimation
