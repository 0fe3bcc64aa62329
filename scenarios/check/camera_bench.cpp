#include "scenarios/check/camera_bench.h"

#include <algorithm>
#include <cmath>

namespace alula::scenarios::check {
namespace {

Frame FrameOf(const stack::Measurement& m, const stack::Image& image) {
  Frame frame{.sensor = m.sensor,
              .seq = m.seq,
              .captured = m.captured,
              .available = m.available,
              .exposure = image.exposure,
              .gain = image.gain,
              .width = image.width,
              .height = image.height,
              .grey = {},
              .bytes = image.bytes};
  frame.grey.reserve(static_cast<std::size_t>(image.width) * image.height);
  for (int v = 0; v < image.height; ++v) {
    const std::uint8_t* row = image.Row(v);
    for (int u = 0; u < image.width; ++u) {
      if (image.format == stack::PixelFormat::kGrey8) {
        frame.grey.push_back(row[u]);
      } else {  // ITU-R BT.601 luma
        const std::uint8_t* p = row + 3 * static_cast<std::ptrdiff_t>(u);
        frame.grey.push_back(static_cast<std::uint8_t>((299 * p[0] + 587 * p[1] + 114 * p[2] + 500) / 1000));
      }
    }
  }
  return frame;
}

}  // namespace

std::vector<CameraGroup> GroupsOf(const sim::SensorsConfig& sensors) {
  std::vector<CameraGroup> groups;
  if (sensors.stereo) groups.emplace_back();
  for (std::size_t i = 0; i < sensors.cameras.size(); ++i) groups.push_back({i});
  return groups;
}

const sim::CameraConfig& ConfigOf(const sim::SensorsConfig& sensors, const CameraGroup& group) {
  if (group.camera) return sensors.cameras[*group.camera];
  return *sensors.stereo;
}

sim::CameraConfig& ConfigOf(sim::SensorsConfig& sensors, const CameraGroup& group) {
  if (group.camera) return sensors.cameras[*group.camera];
  return *sensors.stereo;
}

Rig Isolate(const Rig& rig, const CameraGroup& group) {
  Rig bench = rig;
  sim::SensorsConfig& sensors = bench.sensors;
  sensors.imu.reset();
  sensors.barometer.reset();
  sensors.position_reference.reset();
  sensors.battery_rate = sensors.status_rate = {1, 1};
  if (group.camera) {
    sensors.stereo.reset();
    sensors.cameras = {rig.sensors.cameras[*group.camera]};
  } else {
    sensors.cameras.clear();
  }
  sim::CameraConfig& camera = ConfigOf(sensors, Only(group));
  camera.auto_exposure.reset();
  camera.faults = {};
  camera.sees_vehicle = false;
  for (sim::GimbalConfig& gimbal : sensors.gimbals) gimbal.stabilised = false;
  return bench;
}

Rig WithoutNoise(Rig isolated, const CameraGroup& group) {
  sim::CameraConfig& camera = ConfigOf(isolated.sensors, Only(group));
  camera.noise.read_sigma = camera.noise.shot = 0.0;
  return isolated;
}

std::vector<CameraGeometry> GeometryOf(const Rig& isolated, const CameraGroup& group) {
  const stack::Calibration calibration = sim::TrueCalibration(isolated.sensors, isolated.body, kVehicle);
  const sim::CameraConfig& config = ConfigOf(isolated.sensors, Only(group));
  std::vector<CameraGeometry> geometry;
  for (std::size_t eye = 0; eye < calibration.cameras.size(); ++eye) {
    const stack::CameraCalibration& camera = calibration.cameras[eye];
    base::Transform X_BC =
        group.camera ? sim::MountPose(config) : sim::EyePose(*isolated.sensors.stereo, static_cast<int>(eye));
    if (camera.gimbal) {
      const sim::GimbalConfig& gimbal = isolated.sensors.gimbals[static_cast<std::size_t>(*camera.gimbal)];
      const base::Vec3 held = gimbal.start.cwiseMax(gimbal.low).cwiseMin(gimbal.high);
      X_BC = base::Transform{sim::GimbalRotation(held), gimbal.position} * X_BC;
    }
    geometry.push_back({camera.name, camera.sensor, camera.intrinsics, X_BC});
  }
  return geometry;
}

std::int64_t NearestFrame(base::Rate rate, base::Time t) {
  return std::max<std::int64_t>(0, std::llround(t.Seconds() * rate.Hz()));
}

std::vector<Frame> FramesOf(const std::vector<stack::Measurement>& measurements) {
  std::vector<Frame> frames;
  for (const stack::Measurement& m : measurements) {
    if (const auto* image = std::get_if<stack::Image>(&m.data)) frames.push_back(FrameOf(m, *image));
  }
  return frames;
}

}  // namespace alula::scenarios::check
