#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "scenarios/dataset/recording.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"

namespace alula::scenarios::dataset {

enum class Format : std::uint8_t { kEuroc, kTum };

/// Writes a run as a dataset, one measurement after the other as the stack gets them. Nothing is kept in memory but
/// eight bytes an image. Full disks throw base::FaultError("disk").
class DatasetWriter {
 public:
  virtual ~DatasetWriter() = default;
  /// Measurements that the format has no place for are passed over.
  virtual void Add(const stack::Measurement& measurement) = 0;
  /// What is true of the vehicle's own body frame; ascending in time.
  virtual void Add(const BodyTruth& truth) = 0;
  /// Writes what can only be written at the end; without it the dataset is not whole.
  virtual void Finish() = 0;
};

/// EuRoC's ASL layout under `folder`/mav0: cam0, cam1, … (the stereo pair first; any grey, colour or infrared camera),
/// imu0, state_groundtruth_estimate0, body.yaml. As in EuRoC the dataset's body frame is the IMU's: T_BS of imu0 is the
/// identity, and the ground truth is the IMU's pose and velocity (without an IMU: the vehicle's body). Stamps count
/// from kEurocEpoch. Depth images have no place. `comment` goes into body.yaml. Throws base::InputError where there is
/// neither camera nor IMU, and for a camera on a gimbal: T_BS is constant.
std::unique_ptr<DatasetWriter> MakeEurocWriter(const std::filesystem::path& folder, const stack::Calibration& truth,
                                               std::string_view comment);

/// What stands as stamp for the start of the run: as EuRoC's, stamps then have one number of digits (Kalibr's bag maker
/// cuts nine off the file's name, sorting by name works) and no message is at time 0; seconds in a double keep 0.1 ns.
inline constexpr base::Time kEurocEpoch{1'000'000'000'000'000};

/// TUM's RGB-D layout under `folder`: rgb/ and depth/ (16-bit PNG, 5000 a metre, 0 where nothing was measured or beyond
/// 13.1 m), rgb.txt, depth.txt, accelerometer.txt, groundtruth.txt (pose of the optical frame of the camera of rgb/);
/// besides, rgb.yaml and depth.yaml, which TUM lacks: sensor.yaml as EuRoC's, with that optical frame as body. Stamps
/// are seconds of the run in true time: the cameras' time offsets, which the layout cannot state, are added.
/// The depth camera is the first one; for rgb/ serves the colour camera nearest to it, without any the nearest grey
/// one. Throws base::InputError where either is missing or sits on a gimbal.
std::unique_ptr<DatasetWriter> MakeTumWriter(const std::filesystem::path& folder, const stack::Calibration& truth,
                                             std::string_view comment);

}  // namespace alula::scenarios::dataset
