#include "stack/estimation/sensor_set.h"

#include "base/error.h"

namespace alula::stack::estimation {
namespace {

std::optional<int> FirstCamera(const Calibration& calibration, bool depth) {
  for (std::size_t i = 0; i < calibration.cameras.size(); ++i) {
    if ((calibration.cameras[i].kind == CameraKind::kDepth) == depth) return static_cast<int>(i);
  }
  return std::nullopt;
}

DepthChoice WhatThereIs(const Calibration& calibration) {
  if (calibration.stereo) return DepthChoice::kStereo;
  return FirstCamera(calibration, true) ? DepthChoice::kDepthCamera : DepthChoice::kNone;
}

}  // namespace

void Describe(base::Description& d, SensorsConfig& c) {
  d.Field("depth", c.depth,
          {.meaning = "what measures it; auto: a stereo pair, else a depth camera, else nothing",
           .choices = {"auto", "stereo", "depth_camera", "none"}});
  d.Field("imu", c.imu,
          {.meaning = "whether there is one; auto: as the calibration says", .choices = {"auto", "use", "none"}});
  d.Field("virtual_baseline", c.virtual_baseline,
          {.unit = "m",
           .meaning = "of a stereo pair that measures depth as well as the depth camera",
           .min = 0.01,
           .max = 5});
}

SensorSet ChooseSensors(const Calibration& calibration, const SensorsConfig& config) {
  const DepthChoice depth = config.depth == DepthChoice::kAuto ? WhatThereIs(calibration) : config.depth;
  SensorSet set;
  if (config.imu == ImuChoice::kUse && !calibration.imu)
    throw base::InputError("calibration: no IMU, which odometry.sensors.imu asks for");
  if (config.imu != ImuChoice::kNone) set.imu = calibration.imu;
  const std::optional<int> picture = calibration.stereo ? (*calibration.stereo)[0] : FirstCamera(calibration, false);
  if (!picture) throw base::InputError("calibration: no camera that takes pictures");
  set.picture = *picture;
  const CameraCalibration& camera = calibration.cameras.at(static_cast<std::size_t>(*picture));
  set.X_BC = camera.X_BC;
  switch (depth) {
    case DepthChoice::kAuto:
    case DepthChoice::kStereo:
      set.rig = features::MakeRig(calibration);
      set.right = (*calibration.stereo)[1];
      break;
    case DepthChoice::kDepthCamera:
      set.depth = FirstCamera(calibration, true);
      if (!set.depth) throw base::InputError("calibration: no depth camera, which odometry.sensors.depth asks for");
      set.rig = features::MakeRig(camera, config.virtual_baseline);
      break;
    case DepthChoice::kNone:
      if (!set.imu)
        throw base::InputError(
            "calibration: one camera alone knows no scale; odometry needs a stereo pair, a depth "
            "camera or an IMU beside it");
      set.rig = features::MakeRig(camera, std::nullopt);
  }
  return set;
}

}  // namespace alula::stack::estimation
