#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/check/rig.h"

namespace alula::scenarios::check {

/// Cameras that are recorded together: the stereo pair, one of the further cameras, or an RGB-D camera.
struct CameraGroup {
  enum class Kind : std::uint8_t { kStereo, kCamera, kRgbd };
  Kind kind = Kind::kStereo;
  std::size_t index = 0;  // into SensorsConfig::cameras or ::rgbd
};
std::vector<CameraGroup> GroupsOf(const sim::SensorsConfig& sensors);

/// Optics and times of a group as configured; of RGB-D those of its colour camera.
const sim::CameraConfig& ConfigOf(const sim::SensorsConfig& sensors, const CameraGroup& group);
sim::CameraConfig& ConfigOf(sim::SensorsConfig& sensors, const CameraGroup& group);

/// What the group is called in a rig that holds nothing else.
inline CameraGroup Only(const CameraGroup& group) { return {group.kind, 0}; }

/// The suite with this group alone: no other sensor, exposure fixed at its nominal length and gain 1, no frame lost,
/// the vehicle out of sight, a gimbal held where it starts. Noise, lens, blur and rolling shutter stay.
Rig Isolate(const Rig& rig, const CameraGroup& group);

/// The same without noise of pixels: for what is read off edges.
Rig WithoutNoise(Rig isolated, const CameraGroup& group);

/// Geometry of one camera, on a body that carries it firmly.
struct CameraGeometry {
  std::string name;
  stack::SensorId sensor{};
  stack::CameraIntrinsics intrinsics;
  base::Transform X_BC;
};
/// That of a group's grey, colour or infrared cameras as the configuration of an isolated rig says.
std::vector<CameraGeometry> GeometryOf(const Rig& isolated, const CameraGroup& group);

/// Pose of the body from which a camera stands at X_WC.
inline base::Transform BodyPose(const base::Transform& X_WC, const base::Transform& X_BC) {
  return X_WC * X_BC.Inverse();
}

/// Number of the frame whose time is nearest.
std::int64_t NearestFrame(base::Rate rate, base::Time t);

/// One picture of one camera: its luma, in rows without gaps.
struct Frame {
  stack::SensorId sensor{};
  std::uint32_t seq = 0;
  base::Time captured, available;
  base::Duration exposure;
  double gain = 1.0;
  int width = 0, height = 0;
  std::vector<std::uint8_t> grey;
  std::shared_ptr<const std::vector<std::uint8_t>> bytes;  // as delivered: one or three a pixel
};
/// The frames among measurements, in order of arrival; RGB becomes luma.
std::vector<Frame> FramesOf(const std::vector<stack::Measurement>& measurements);

}  // namespace alula::scenarios::check
