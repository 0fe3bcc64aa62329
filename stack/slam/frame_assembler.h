#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>

#include "stack/estimation/odometry.h"
#include "stack/features/depth_registration.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"

namespace alula::stack::slam {

/// Puts the images of one instant and the inertial samples that lead to them together: both of a stereo pair, else a
/// picture and the depth image of the same number (drawn as the picture's camera sees it), else a picture. Stamps of
/// images become IMU time by the calibration's nominal offset.
class FrameAssembler {
 public:
  /// Throws base::InputError as estimation::ChooseSensors does.
  explicit FrameAssembler(const Calibration& calibration);

  /// What frames are made of is kept, everything else is passed over.
  void Add(const Measurement& measurement);
  bool IsEye(SensorId sensor) const { return sensor == left_.sensor || (right_ && sensor == right_->sensor); }

  /// The oldest whole frame, once the inertial samples reach its stamp; each is given once. A frame of which a part
  /// never came is dropped when a later one is whole.
  std::optional<estimation::FrameInput> Next();
  /// The samples of a frame that was processed are no longer needed; those of one that was skipped go with the next.
  void Consume(const estimation::FrameInput& frame);

 private:
  struct Parts {
    base::Time stamp;
    std::optional<Image> left, right;
    std::optional<DepthImage> depth;
  };

  bool Whole(const Parts& parts) const;

  CameraCalibration left_;
  std::optional<CameraCalibration> right_, depth_;
  std::optional<features::DepthRegistration> registration_;
  std::optional<SensorId> imu_sensor_;
  std::deque<estimation::TimedImu> imu_;
  std::map<std::uint32_t, Parts> frames_;
};

}  // namespace alula::stack::slam
