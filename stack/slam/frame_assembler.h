#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "stack/estimation/odometry.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"

namespace alula::stack::slam {

/// Puts the two images of a stereo pair and the inertial samples that lead to them together. Stamps of images become
/// IMU time by the calibration's nominal offset.
class FrameAssembler {
 public:
  /// Throws base::InputError where the calibration has no stereo pair or no IMU.
  explicit FrameAssembler(const Calibration& calibration);

  /// Images of the pair and samples of the IMU are kept, everything else is passed over.
  void Add(const Measurement& measurement);
  bool IsEye(SensorId sensor) const { return sensor == left_.sensor || sensor == right_.sensor; }

  /// The oldest whole pair, once the inertial samples reach its stamp; each is given once. A pair whose other eye never
  /// came is dropped when a later one is whole.
  std::optional<estimation::FrameInput> Next();
  /// The samples of a frame that was processed are no longer needed; those of one that was skipped go with the next.
  void Consume(const estimation::FrameInput& frame);

 private:
  struct Pair {
    base::Time stamp;
    std::optional<Image> left, right;
  };

  CameraCalibration left_, right_;
  SensorId imu_sensor_{};
  std::deque<estimation::TimedImu> imu_;
  std::map<std::uint32_t, Pair> pairs_;
};

}  // namespace alula::stack::slam
