#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "base/frames.h"
#include "base/time.h"

namespace alula::stack {

/// Names a sensor of the run; the calibration lists id and name ("vehicle0/camera.left") together.
enum class SensorId : std::uint16_t {};

/// What an IMU reads, in the IMU frame I: angular velocity w_I (rad/s) and specific force f_I = R_IW (a_WI − g_W)
/// (m/s²; at rest on level ground it reads +9.81 along the upward axis).
struct ImuSample {
  base::Vec3 angular_velocity;
  base::Vec3 specific_force;
};

enum class PixelFormat : std::uint8_t { kGrey8, kRgb8 };

/// An image as a camera delivers it: rows from the top, `stride` bytes apart. The pixels are shared and never change.
/// Pixel (u, v) covers [u − ½, u + ½] × [v − ½, v + ½]: integer coordinates are pixel centres.
struct Image {
  PixelFormat format = PixelFormat::kGrey8;
  int width = 0;
  int height = 0;
  int stride = 0;
  base::Time exposure_start;
  base::Duration exposure;
  double gain = 1.0;
  std::shared_ptr<const std::vector<std::uint8_t>> bytes;

  const std::uint8_t* Row(int v) const { return bytes->data() + static_cast<std::size_t>(v) * stride; }
};

/// What a depth camera delivers: planar depth (along the optical axis) in millimetres, rows from the top without gaps;
/// 0 where it could not measure.
struct DepthImage {
  int width = 0;
  int height = 0;
  base::Time exposure_start;
  base::Duration exposure;
  std::shared_ptr<const std::vector<std::uint16_t>> millimetres;
};

/// Where a gimbal's encoders say that it stands, rad (calibration.h: GimbalCalibration).
struct GimbalAngles {
  double roll = 0.0;
  double pitch = 0.0;
  double yaw = 0.0;
};

/// Static pressure, Pa.
struct BaroSample {
  double pressure = 0.0;
};

/// Magnetic flux density, T, in the magnetometer's own axes M (calibration.h has their rotation against the body).
struct MagSample {
  base::Vec3 magnetic_field;
};

/// Pose of the body in the world from an external reference (motion capture).
struct PositionFix {
  base::Transform X_WB;
  double position_sigma = 0.0;  // m, per axis
  double attitude_sigma = 0.0;  // rad, per axis
};

struct BatterySample {
  double voltage = 0.0;  // V
  double current = 0.0;  // A
};

/// What an autopilot reports of itself. `landed` is its own judgement, made from its own sensors.
struct VehicleStatus {
  enum class Mode : std::uint8_t { kDisarmed, kReady, kFollowing, kHolding, kLanding };
  Mode mode = Mode::kDisarmed;
  bool armed = false;
  bool ready_to_arm = false;
  bool landed = true;
  double thrust = 0.0;  // commanded collective thrust, share of the maximum in [0, 1]
};

/// One measurement of one sensor. `captured` is the instant it describes (for images the middle of the exposure, on the
/// sensor's own idea of time), `available` when it reaches the stack. A stereo pair is two images with the same `seq`.
struct Measurement {
  SensorId sensor{};
  std::uint32_t seq = 0;
  base::Time captured;
  base::Time available;
  std::variant<ImuSample, Image, BaroSample, PositionFix, BatterySample, VehicleStatus, DepthImage, GimbalAngles,
               MagSample>
      data;
};

/// The order in which measurements are handed over.
inline bool ArrivesBefore(const Measurement& a, const Measurement& b) {
  if (a.available != b.available) return a.available < b.available;
  if (a.sensor != b.sensor) return a.sensor < b.sensor;
  return a.seq < b.seq;
}

}  // namespace alula::stack
