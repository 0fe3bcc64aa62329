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
  using Kind = CameraGroup::Kind;
  std::vector<CameraGroup> groups;
  if (sensors.stereo) groups.push_back({Kind::kStereo, 0});
  for (std::size_t i = 0; i < sensors.cameras.size(); ++i) groups.push_back({Kind::kCamera, i});
  for (std::size_t i = 0; i < sensors.rgbd.size(); ++i) groups.push_back({Kind::kRgbd, i});
  return groups;
}

sim::CameraConfig& ConfigOf(sim::SensorsConfig& sensors, const CameraGroup& group) {
  switch (group.kind) {
    case CameraGroup::Kind::kStereo:
      return *sensors.stereo;
    case CameraGroup::Kind::kCamera:
      return sensors.cameras[group.index];
    case CameraGroup::Kind::kRgbd:
      break;
  }
  return sensors.rgbd[group.index];
}

const sim::CameraConfig& ConfigOf(const sim::SensorsConfig& sensors, const CameraGroup& group) {
  return ConfigOf(const_cast<sim::SensorsConfig&>(sensors), group);
}

Rig Isolate(const Rig& rig, const CameraGroup& group) {
  Rig bench = rig;
  sim::SensorsConfig& sensors = bench.sensors;
  sensors.imu.reset();
  sensors.barometer.reset();
  sensors.magnetometer.reset();
  sensors.position_reference.reset();
  sensors.gnss.reset();
  sensors.battery_rate = sensors.status_rate = {1, 1};
  using Kind = CameraGroup::Kind;
  if (group.kind != Kind::kStereo) sensors.stereo.reset();
  sensors.cameras.clear();
  sensors.rgbd.clear();
  if (group.kind == Kind::kCamera) sensors.cameras = {rig.sensors.cameras[group.index]};
  if (group.kind == Kind::kRgbd) sensors.rgbd = {rig.sensors.rgbd[group.index]};
  sim::CameraConfig& camera = ConfigOf(sensors, Only(group));
  camera.auto_exposure.reset();
  camera.faults = {};
  camera.sees_vehicle = false;
  camera.lamps.clear();  // they would light the board unevenly
  camera.dirt = {};
  camera.glare = {};
  camera.gamma = 1.0;  // the photon-transfer curve is that of the linear signal
  camera.bits = 8;
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
    if (camera.kind == stack::CameraKind::kDepth) continue;
    base::Transform X_BC = group.kind == CameraGroup::Kind::kStereo
                               ? sim::EyePose(*isolated.sensors.stereo, static_cast<int>(eye))
                               : sim::MountPose(config);
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
