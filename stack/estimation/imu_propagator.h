#pragma once

#include <deque>
#include <optional>

#include "base/frames.h"
#include "base/time.h"
#include "stack/estimation/odometry.h"
#include "stack/interface/calibration.h"
#include "stack/interface/navigation_stack.h"

namespace alula::stack::estimation {

/// Carries the last corrected state of the odometry to now by integrating the IMU (trapezoidal rule). Each sample is
/// integrated once; a correction starts again from its stamp with the buffered samples. X_MO of the estimate is left
/// at identity: it belongs to whoever knows the map.
class ImuPropagator {
 public:
  /// Throws base::InputError where the calibration has no IMU.
  explicit ImuPropagator(const Calibration& calibration);

  /// Samples come in order of time.
  void AddImu(const TimedImu& sample);
  /// Results that are not initialised, or older than the last, are ignored.
  void Correct(const FrameResult& result);
  /// The estimate at `now`, at or after the last sample that was added (the last sample is held up to `now`); none
  /// before the first correction.
  std::optional<Estimate> At(base::Time now) const;

 private:
  /// Pose and velocity of the IMU frame at `stamp`.
  struct Motion {
    base::Time stamp;
    base::Transform X_OI;
    base::Vec3 v_OI = base::Vec3::Zero();
  };
  Motion Advance(const Motion& from, const TimedImu& a, const TimedImu& b, base::Time to) const;

  base::Transform X_BI_;
  ImuNoise noise_;
  std::deque<TimedImu> samples_;  // from the last one at or before the corrected stamp on
  std::optional<FrameResult> corrected_;
  Motion head_;  // integrated up to the newest sample
};

}  // namespace alula::stack::estimation
