#pragma once

#include <optional>

#include "base/describe.h"
#include "stack/features/stereo_rig.h"
#include "stack/interface/calibration.h"

namespace alula::stack::estimation {

enum class DepthChoice { kAuto, kStereo, kDepthCamera, kNone };
enum class ImuChoice { kAuto, kUse, kNone };

/// Of what a vehicle has, what the odometry looks at.
struct SensorsConfig {
  DepthChoice depth = DepthChoice::kAuto;  // the first of: stereo pair, depth camera, nothing
  ImuChoice imu = ImuChoice::kAuto;
  double virtual_baseline = 1.0;  // m: how sure depth images are, as the baseline of a pair that measured so.
                                  // A Kinect has σ_z = 1.4e-3 z² (Khoshelham and Elberink 2012): 1.3 m
};
void Describe(base::Description& d, SensorsConfig& c);

/// The sensors of one composition: indices into Calibration::cameras.
struct SensorSet {
  int picture = 0;                  // the camera whose corners are followed
  std::optional<int> right, depth;  // at most one of them
  std::optional<ImuCalibration> imu;
  features::StereoRig rig;
  base::Transform X_BC;  // of the picture
};

/// Throws base::InputError where the calibration lacks what is asked for, and for one camera without an IMU, which
/// knows no scale.
SensorSet ChooseSensors(const Calibration& calibration, const SensorsConfig& config);

}  // namespace alula::stack::estimation
