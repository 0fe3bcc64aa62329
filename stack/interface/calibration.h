#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/frames.h"
#include "base/time.h"
#include "stack/interface/measurement.h"

namespace alula::stack {

/// How a lens bends rays.
enum class DistortionModel : std::uint8_t {
  kRadialTangential,  // k1 k2 p1 p2 k3 of the normalised point (Brown 1971, as OpenCV orders them)
  kEquidistant,       // k1 k2 k3 k4 of the angle to the axis (Kannala and Brandt 2006; OpenCV's fisheye)
};

/// A camera's geometry: camera_model.h has the equations. Focal lengths and centre in pixels.
struct CameraIntrinsics {
  int width = 0;
  int height = 0;
  double fx = 0.0;
  double fy = 0.0;
  double cx = 0.0;
  double cy = 0.0;
  std::array<double, 5> distortion{};  // in the model's order; what it does not use is 0
  DistortionModel model = DistortionModel::kRadialTangential;
};

/// What a camera delivers.
enum class CameraKind : std::uint8_t { kGrey, kColour, kInfrared, kDepth };

struct CameraCalibration {
  SensorId sensor{};
  std::string name;  // "vehicle0/camera.left"
  CameraIntrinsics intrinsics;
  base::Transform X_BC;  // on a gimbal: with all its angles zero
  base::Rate rate;
  /// What must be added to a `captured` stamp to get IMU time.
  base::Duration time_offset;
  CameraKind kind = CameraKind::kGrey;
  base::Duration row_delay{};   // from one row's exposure to the next one's; 0: global shutter
  std::optional<int> gimbal{};  // index into Calibration::gimbals
};

/// A mount that turns cameras about one point: first yaw about the body's z, then pitch (positive: down), then roll.
struct GimbalCalibration {
  SensorId sensor{};                     // GimbalAngles
  std::string name;                      // "vehicle0/gimbal.0"
  base::Vec3 p_BG = base::Vec3::Zero();  // the point that does not move
};

/// Noise as in Kalibr: continuous-time densities.
struct ImuNoise {
  double gyro_noise = 0.0;                  // rad/s/√Hz
  double accelerometer_noise = 0;           // m/s²/√Hz
  double gyro_bias_walk = 0.0;              // rad/s²/√Hz
  double accelerometer_bias_walk = 0.0;     // m/s³/√Hz
  double gyro_turn_on_bias = 0.0;           // 1σ, rad/s
  double accelerometer_turn_on_bias = 0.0;  // 1σ, m/s²
  double gyro_range = 0.0;                  // saturation, rad/s
  double accelerometer_range = 0;           // saturation, m/s²
};

struct ImuCalibration {
  SensorId sensor{};
  std::string name;
  base::Transform X_BI;
  base::Rate rate;
  ImuNoise noise;
};

struct BarometerCalibration {
  SensorId sensor{};
  std::string name;
  double noise = 0.0;  // 1σ, Pa
};

struct MagnetometerCalibration {
  SensorId sensor{};
  std::string name;
  base::Quat q_BM = base::Quat::Identity();
  base::Rate rate;
  double noise = 0.0;  // 1σ per axis, T
  /// Earth's field here as a model of it says (WMM), T, mission's world axes: what gives heading and declination.
  base::Vec3 B_W = base::Vec3::Zero();
};

/// Gives PositionFix.
struct PositionReferenceCalibration {
  SensorId sensor{};
  std::string name;
};

/// What a stack is told about its vehicle once, before the first step. It is as wrong as a real calibration is.
struct Calibration {
  std::string vehicle;  // "vehicle0"
  std::vector<CameraCalibration> cameras;
  /// Indices into `cameras` of the left and right eye, where the vehicle has a stereo pair.
  std::optional<std::array<int, 2>> stereo;
  std::vector<GimbalCalibration> gimbals;
  std::optional<ImuCalibration> imu;
  std::optional<BarometerCalibration> barometer;
  std::optional<PositionReferenceCalibration> position_reference;
  std::optional<PositionReferenceCalibration> gnss;  // a receiver of satellites: position alone
  std::optional<MagnetometerCalibration> magnetometer;
  SensorId status_sensor{};   // VehicleStatus
  SensorId battery_sensor{};  // BatterySample
  /// Smallest sphere about the body origin that holds the hull (body and propeller discs), m.
  double hull_radius = 0.0;
  /// Half extents of the hull's bounding box in the body frame, m.
  base::Vec3 hull_half_extents = base::Vec3::Zero();
  /// Height of the body origin above the ground when standing, m.
  double standing_height = 0.0;
};

}  // namespace alula::stack
