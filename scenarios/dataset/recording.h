#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "base/trajectory_file.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"

namespace alula::scenarios::dataset {

struct ImuReading {
  base::Time time;
  stack::ImuSample sample;
};

/// What is true of a recording's body B at an instant; zero where the layout does not say it. Biases are what the IMU
/// adds to its readings, in its axes.
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

/// How a recording lies on the disk; layouts.h has what each is.
enum class Layout : std::uint8_t { kEuroc, kKitti, kTum };

/// Of a recording with a depth camera: which picture its images belong to and what they hold.
struct DepthStream {
  std::size_t camera = 0;          // index into Recording::calibration.cameras
  std::size_t picture = 0;         // the camera whose images go with it
  double values_per_metre = 1000;  // of the 16-bit files
  /// For each image of `picture` the index of the depth image nearest in time; none where there is none near enough.
  std::vector<std::optional<std::size_t>> of_picture;
};

/// A recorded sequence. Its body frame B is that of the recording (EuRoC: the IMU's; KITTI and TUM: forward-left-up at
/// the optical centre of the first camera), its times count from an epoch of its own.
struct Recording {
  Layout layout = Layout::kEuroc;
  stack::Calibration calibration;              // cameras as the files number them
  std::vector<std::vector<ImageFile>> images;  // of each camera, ascending in time
  std::optional<DepthStream> depth;
  std::vector<ImuReading> imu;   // ascending in time
  std::vector<BodyTruth> truth;  // ascending in time; empty where the recording has none
  int missing_images = 0;        // stamps without a file
};

/// When the images were taken, in their order.
std::vector<base::Time> StampsOf(const std::vector<ImageFile>& images);

/// The poses X_WB of the truth, as a judge of an estimate wants them.
std::vector<base::StampedPose> TrueTrajectory(const Recording& recording);

}  // namespace alula::scenarios::dataset
