#pragma once

#include <memory>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "scenarios/dataset/recording.h"

// Measurements and calibrations that no simulator made, with every field set to something of its own.
namespace alula::scenarios::dataset::testing {

inline stack::Image RandomImage(int width, int height, stack::PixelFormat format, std::uint64_t seed) {
  base::RandomStream random(seed, "image");
  const int channels = format == stack::PixelFormat::kGrey8 ? 1 : 3;
  stack::Image image;
  image.format = format;
  image.width = width;
  image.height = height;
  image.stride = width * channels + 5;  // rows with a gap
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(image.stride * height));
  for (std::uint8_t& b : bytes) b = static_cast<std::uint8_t>(random.Bits());
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(bytes));
  return image;
}

/// The pixels without the gaps between rows.
inline std::vector<std::uint8_t> Pixels(const stack::Image& image) {
  const int row = image.width * (image.format == stack::PixelFormat::kGrey8 ? 1 : 3);
  std::vector<std::uint8_t> pixels;
  for (int v = 0; v < image.height; ++v) pixels.insert(pixels.end(), image.Row(v), image.Row(v) + row);
  return pixels;
}

inline stack::CameraCalibration Camera(int sensor, const std::string& name, stack::CameraKind kind) {
  stack::CameraCalibration camera;
  camera.sensor = static_cast<stack::SensorId>(sensor);
  camera.name = name;
  camera.kind = kind;
  camera.intrinsics = {.width = 24 + sensor,
                       .height = 16,
                       .fx = 20.1 + sensor,
                       .fy = 20.2,
                       .cx = 11.7,
                       .cy = 1.0 / 3.0,
                       .distortion = {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0}};
  camera.X_BC = {base::FromYawPitchRoll(0.1 * sensor, 0.2, -0.3) * base::ForwardCameraRotation(),
                 {0.1, 0.01 * sensor, -0.02}};
  camera.rate = {20, 1};
  return camera;
}

/// A pair, a rolling-shutter colour camera before it, a fisheye that is late, a depth camera; an IMU with a lever arm.
inline stack::Calibration EverySensor() {
  using stack::CameraKind;
  stack::Calibration c;
  c.vehicle = "vehicle0";
  c.cameras = {Camera(14, "colour", CameraKind::kColour), Camera(10, "left", CameraKind::kGrey),
               Camera(11, "right \"eye\"", CameraKind::kGrey), Camera(12, "fisheye", CameraKind::kInfrared),
               Camera(13, "depth", CameraKind::kDepth)};
  c.cameras[0].row_delay = base::Microseconds(30);
  c.cameras[0].rate = {30000, 1001};
  c.cameras[0].intrinsics.distortion[4] = 0.01;
  c.cameras[3].intrinsics.model = stack::DistortionModel::kEquidistant;
  c.cameras[3].time_offset = base::Microseconds(-1500);
  c.stereo = {1, 2};
  c.imu.emplace();
  c.imu->sensor = stack::SensorId{1};
  c.imu->name = "vehicle0/imu";
  c.imu->X_BI = {base::FromYawPitchRoll(0.3, -0.2, 0.1), {0.02, 0.01, -0.03}};
  c.imu->rate = {200, 1};
  c.imu->noise = {.gyro_noise = 1.7e-4,
                  .accelerometer_noise = 2.0e-3,
                  .gyro_bias_walk = 1.0 / 3e5,
                  .accelerometer_bias_walk = 3.1e-3};
  return c;
}

/// The message of the InputError that `action` throws; empty where it throws none.
template <typename Action>
std::string Complaint(const Action& action) {
  try {
    action();
  } catch (const base::InputError& e) {
    return e.what();
  }
  return {};
}

}  // namespace alula::scenarios::dataset::testing
