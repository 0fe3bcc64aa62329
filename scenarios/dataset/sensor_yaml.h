#pragma once

#include <string>
#include <string_view>

#include "stack/interface/calibration.h"

namespace alula::scenarios::dataset {

// EuRoC's sensor.yaml. T_BS is the pose of the sensor frame S in the body frame B: our X_BC and X_BI. Noise densities
// are those of the continuous-time model, as in stack::ImuNoise. Two keys that EuRoC lacks, with Kalibr's names, are
// written where they are not zero:
//   timeshift_cam_imu   s; t_imu = t_cam + timeshift_cam_imu
//   line_delay          s; from one row's exposure to the next one's
// `comment` holds the sensor's name.

std::string CameraYaml(const stack::CameraCalibration& camera);
std::string ImuYaml(const stack::ImuCalibration& imu);
/// Of state_groundtruth_estimate0: a sensor that sits in the body frame.
std::string GroundTruthYaml(std::string_view comment);
std::string BodyYaml(std::string_view comment);

/// Read what was written, and EuRoC's own. `file_name` goes into messages. What a file does not say (sensor ids,
/// turn-on biases, ranges) stays zero. Throws base::InputError with file, line and column.
stack::CameraCalibration ReadCameraYaml(std::string_view text, const std::string& file_name);
stack::ImuCalibration ReadImuYaml(std::string_view text, const std::string& file_name);

}  // namespace alula::scenarios::dataset
