#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"

namespace alula::scenarios::dataset {

struct ImuReading {
  base::Time time;
  stack::ImuSample sample;
};

/// What is true of a recording's body B at an instant. Biases are what the IMU adds to its readings, in its axes.
struct BodyTruth {
  base::Time time;
  base::Transform X_WB;
  base::Vec3 v_WB = base::Vec3::Zero();
  base::Vec3 w_B = base::Vec3::Zero();                 // rad/s; files do not hold it
  base::Vec3 gyro_bias = base::Vec3::Zero();           // rad/s
  base::Vec3 accelerometer_bias = base::Vec3::Zero();  // m/s²
};

/// An image of a recording that is read when it is wanted.
struct ImageFile {
  base::Time captured;  // as the camera stamps it
  std::filesystem::path file;
};

/// A recorded sequence. Its body frame B is that of the recording (EuRoC: the IMU's), its times count from an epoch of
/// its own.
struct Recording {
  stack::Calibration calibration;              // cameras as the files number them; the first two are the stereo pair
  std::vector<std::vector<ImageFile>> images;  // of each camera, ascending in time
  std::vector<ImuReading> imu;                 // ascending in time
  std::vector<BodyTruth> truth;                // ascending in time; empty where the recording has none
  int missing_images = 0;                      // stamps without a file
};

}  // namespace alula::scenarios::dataset
