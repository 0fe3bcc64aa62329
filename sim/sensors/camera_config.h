#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/describe.h"
#include "base/frames.h"
#include "base/time.h"
#include "render/sensor_effects.h"
#include "render/structured_light.h"
#include "stack/interface/calibration.h"
#include "worlds/lighting.h"

namespace alula::sim {

/// How the lens bends rays; stack/interface/camera_model.h has the equations.
struct LensConfig {
  stack::DistortionModel model = stack::DistortionModel::kRadialTangential;
  std::vector<double> coefficients;  // k1 k2 p1 p2 k3, or k1 k2 k3 k4; none: no distortion
};
void Describe(base::Description& d, LensConfig& c);

/// Exposure that follows the light: after each frame delivered the product of exposure and gain moves towards the one
/// that would have brought the frame's mean to `target`; first the exposure up to `longest`, then the gain.
struct AutoExposureConfig {
  double target = 0.42;                               // mean of the picture, share of full scale
  double speed = 0.5;                                 // share of the error (in stops) taken away a frame
  int delay = 2;                                      // frames from the measurement to the frame that obeys it
  base::Duration shortest = base::Microseconds(100);  // of the exposure
  base::Duration longest = base::Milliseconds(8);
  double largest_gain = 8.0;
};
void Describe(base::Description& d, AutoExposureConfig& c);

/// What happens to frames on the way. Each is drawn frame by frame from a stream of the camera.
struct FrameFaultsConfig {
  double drop = 0.0;                                // share that never arrives
  double late = 0.0;                                // share that arrives late
  base::Duration late_by = base::Milliseconds(50);  // at most; uniform
  double freeze = 0.0;                              // share of frames at which the camera gets stuck
  int freeze_frames = 5;                            // so many frames show the one before
};
void Describe(base::Description& d, FrameFaultsConfig& c);

/// One camera: what it sees, when, and with which faults; what its lens and sensor do to the light stands beside it
/// (noise, vignetting, dirt, glare, gamma, …). Mounted in the body frame, or in a gimbal's, looking along that frame's
/// x axis where yaw, pitch and roll are 0.
struct CameraConfig : render::SensorEffects {
  stack::CameraKind kind = stack::CameraKind::kGrey;
  base::Rate rate{20, 1};
  int width = 640;                  // px
  int height = 480;                 // px
  double fov = 1.3962634015954636;  // across the width, rad (80 deg)
  LensConfig lens;
  base::Vec3 position{0.10, 0.0, -0.02};  // m
  double yaw = 0.0;                       // to the left, rad
  double pitch = 0.0;                     // below the horizon of the mount, rad
  double roll = 0.0;                      // rad
  std::string gimbal;                     // the one that it sits on; none: the body
  base::Origin gimbal_origin{};
  base::Duration exposure = base::Milliseconds(4);  // stamps are of its middle; the light is set for this length
  std::optional<AutoExposureConfig> auto_exposure;
  bool motion_blur = false;
  base::Duration row_delay{};  // rolling shutter: from one row to the next; stamps are of the middle
  base::Duration read_out = base::Milliseconds(10);
  bool sees_vehicle = false;
  std::vector<worlds::Lamp> lamps;  // that ride with it, in camera axes: the illuminator of an infrared camera
  FrameFaultsConfig faults;
};
void Describe(base::Description& d, CameraConfig& c);

/// A camera with a name of its own.
struct NamedCameraConfig : CameraConfig {
  std::string name;
};
void Describe(base::Description& d, NamedCameraConfig& c);

/// Two equal cameras side by side. The right one may be late: P3's pair is not triggered together.
struct StereoCameraConfig : CameraConfig {
  double baseline = 0.11;       // m
  base::Duration eye_offset{};  // the right eye exposes so much later than its stamp says …
  int eye_offset_every = 1;     // … in every n-th frame
};
void Describe(base::Description& d, StereoCameraConfig& c);

/// A colour camera with a structured-light depth camera beside it, which looks the same way and takes its depth in the
/// middle of the colour camera's exposure.
struct DepthCameraConfig {
  int width = 640;
  int height = 480;
  double fov = 1.0122909661567112;  // across the width, rad (58 deg)
  double offset = -0.025;           // along the colour camera's x axis, m
  bool registered = true;           // carried over to the colour camera's pixels
  base::Duration read_out = base::Milliseconds(30);
  render::StructuredLight light;
};
void Describe(base::Description& d, DepthCameraConfig& c);

struct RgbdCameraConfig : NamedCameraConfig {
  RgbdCameraConfig();
  DepthCameraConfig depth;
};
void Describe(base::Description& d, RgbdCameraConfig& c);

/// Of the depth camera itself, whatever it is registered to.
stack::CameraIntrinsics DepthIntrinsicsOf(const DepthCameraConfig& config);

/// Square pixels, centre of the image. `fov` is what the bent lens really sees across the middle row.
stack::CameraIntrinsics IntrinsicsOf(const CameraConfig& config);

/// Pose of the camera in its mount (body or gimbal).
base::Transform MountPose(const CameraConfig& config);
/// Pose of eye 0 (left) or 1 (right) in the mount.
base::Transform EyePose(const StereoCameraConfig& config, int eye);

}  // namespace alula::sim
