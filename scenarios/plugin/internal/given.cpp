#include "scenarios/plugin/internal/given.h"

#include <algorithm>
#include <string>
#include <variant>

namespace alula::scenarios::plugin {
namespace {

// The words of both sides agree.
static_assert(ALULA_RADIAL_TANGENTIAL == static_cast<int>(stack::DistortionModel::kRadialTangential));
static_assert(ALULA_EQUIDISTANT == static_cast<int>(stack::DistortionModel::kEquidistant));
static_assert(ALULA_CAMERA_GREY == static_cast<int>(stack::CameraKind::kGrey));
static_assert(ALULA_CAMERA_COLOUR == static_cast<int>(stack::CameraKind::kColour));
static_assert(ALULA_CAMERA_INFRARED == static_cast<int>(stack::CameraKind::kInfrared));
static_assert(ALULA_CAMERA_DEPTH == static_cast<int>(stack::CameraKind::kDepth));
static_assert(ALULA_GREY8 == static_cast<int>(stack::PixelFormat::kGrey8));
static_assert(ALULA_RGB8 == static_cast<int>(stack::PixelFormat::kRgb8));
static_assert(ALULA_MODE_DISARMED == static_cast<int>(stack::VehicleStatus::Mode::kDisarmed));
static_assert(ALULA_MODE_READY == static_cast<int>(stack::VehicleStatus::Mode::kReady));
static_assert(ALULA_MODE_FOLLOWING == static_cast<int>(stack::VehicleStatus::Mode::kFollowing));
static_assert(ALULA_MODE_HOLDING == static_cast<int>(stack::VehicleStatus::Mode::kHolding));
static_assert(ALULA_MODE_LANDING == static_cast<int>(stack::VehicleStatus::Mode::kLanding));

AlulaText Write(const std::string& text) { return {text.c_str(), text.size()}; }
AlulaVec3 Write(const base::Vec3& v) { return {v.x(), v.y(), v.z()}; }
AlulaQuat Write(const base::Quat& q) { return {q.w(), q.x(), q.y(), q.z()}; }
AlulaTransform Write(const base::Transform& X) { return {Write(X.q), Write(X.p)}; }
std::uint16_t Write(stack::SensorId id) { return static_cast<std::uint16_t>(id); }

AlulaCameraCalibration Write(const stack::CameraCalibration& camera) {
  AlulaCameraCalibration c{};
  c.name = Write(camera.name);
  c.X_BC = Write(camera.X_BC);
  c.fx = camera.intrinsics.fx;
  c.fy = camera.intrinsics.fy;
  c.cx = camera.intrinsics.cx;
  c.cy = camera.intrinsics.cy;
  std::copy(camera.intrinsics.distortion.begin(), camera.intrinsics.distortion.end(), c.distortion);
  c.rate_cycles = camera.rate.cycles;
  c.rate_seconds = camera.rate.seconds;
  c.time_offset_ns = camera.time_offset.ns;
  c.row_delay_ns = camera.row_delay.ns;
  c.width = camera.intrinsics.width;
  c.height = camera.intrinsics.height;
  c.gimbal = camera.gimbal.value_or(-1);
  c.model = static_cast<std::uint32_t>(camera.intrinsics.model);
  c.kind = static_cast<std::uint32_t>(camera.kind);
  c.sensor = Write(camera.sensor);
  return c;
}

AlulaGimbalCalibration Write(const stack::GimbalCalibration& gimbal) {
  return {Write(gimbal.name), Write(gimbal.p_BG), Write(gimbal.sensor), {}};
}

AlulaImuCalibration Write(const stack::ImuCalibration& imu) {
  return {Write(imu.name),
          Write(imu.X_BI),
          imu.rate.cycles,
          imu.rate.seconds,
          imu.noise.gyro_noise,
          imu.noise.accelerometer_noise,
          imu.noise.gyro_bias_walk,
          imu.noise.accelerometer_bias_walk,
          imu.noise.gyro_turn_on_bias,
          imu.noise.accelerometer_turn_on_bias,
          imu.noise.gyro_range,
          imu.noise.accelerometer_range,
          Write(imu.sensor),
          {}};
}

AlulaMagnetometerCalibration Write(const stack::MagnetometerCalibration& m) {
  return {Write(m.name), Write(m.q_BM), m.rate.cycles, m.rate.seconds, m.noise, Write(m.B_W), Write(m.sensor), {}};
}

AlulaGateHint Write(const stack::GateHint& gate) { return {Write(gate.name), Write(gate.X_WG), gate.opening}; }

template <typename From, typename To>
void WriteAll(const std::vector<From>& from, std::vector<To>& to) {
  for (const From& element : from) to.push_back(Write(element));
}

/// Fills the kind and the data of a measurement.
struct DataWriter {
  AlulaMeasurement& m;

  void operator()(const stack::ImuSample& s) const {
    m.kind = ALULA_IMU;
    m.data.imu = {Write(s.angular_velocity), Write(s.specific_force)};
  }
  void operator()(const stack::Image& s) const {
    m.kind = ALULA_IMAGE;
    m.data.image = {s.bytes->data(), s.bytes->size(), s.exposure_start.ns,
                    s.exposure.ns,   s.gain,          s.width,
                    s.height,        s.stride,        static_cast<std::uint32_t>(s.format)};
  }
  void operator()(const stack::BaroSample& s) const {
    m.kind = ALULA_BARO;
    m.data.baro = {s.pressure};
  }
  void operator()(const stack::PositionFix& s) const {
    m.kind = ALULA_POSITION_FIX;
    m.data.position_fix = {Write(s.X_WB), s.position_sigma, s.attitude_sigma};
  }
  void operator()(const stack::BatterySample& s) const {
    m.kind = ALULA_BATTERY;
    m.data.battery = {s.voltage, s.current};
  }
  void operator()(const stack::VehicleStatus& s) const {
    m.kind = ALULA_VEHICLE_STATUS;
    m.data.status = {s.thrust, static_cast<std::uint32_t>(s.mode), s.armed, s.ready_to_arm, s.landed};
  }
  void operator()(const stack::DepthImage& s) const {
    m.kind = ALULA_DEPTH_IMAGE;
    m.data.depth_image = {
        s.millimetres->data(), s.millimetres->size(), s.exposure_start.ns, s.exposure.ns, s.width, s.height};
  }
  void operator()(const stack::GimbalAngles& s) const {
    m.kind = ALULA_GIMBAL_ANGLES;
    m.data.gimbal = {s.roll, s.pitch, s.yaw};
  }
  void operator()(const stack::MagSample& s) const {
    m.kind = ALULA_MAG;
    m.data.mag = {Write(s.magnetic_field)};
  }
};

}  // namespace

Given::Given(const stack::Calibration& calibration, const stack::Mission& mission)
    : calibration_(calibration), mission_(mission) {
  WriteAll(calibration_.cameras, cameras_);
  WriteAll(calibration_.gimbals, gimbals_);
  AlulaCalibration& c = c_calibration_;
  c.vehicle = Write(calibration_.vehicle);
  c.cameras = cameras_.data();
  c.camera_count = cameras_.size();
  c.gimbals = gimbals_.data();
  c.gimbal_count = gimbals_.size();
  if (calibration_.imu) {
    imu_ = Write(*calibration_.imu);
    c.imu = &imu_;
  }
  if (const auto& barometer = calibration_.barometer) {
    barometer_ = {Write(barometer->name), barometer->noise, Write(barometer->sensor), {}};
    c.barometer = &barometer_;
  }
  if (const auto& reference = calibration_.position_reference) {
    position_reference_ = {Write(reference->name), Write(reference->sensor), {}};
    c.position_reference = &position_reference_;
  }
  if (const auto& gnss = calibration_.gnss) {
    gnss_ = {Write(gnss->name), Write(gnss->sensor), {}};
    c.gnss = &gnss_;
  }
  if (calibration_.magnetometer) {
    magnetometer_ = Write(*calibration_.magnetometer);
    c.magnetometer = &magnetometer_;
  }
  c.hull_radius = calibration_.hull_radius;
  c.hull_half_extents = Write(calibration_.hull_half_extents);
  c.standing_height = calibration_.standing_height;
  c.stereo_left = calibration_.stereo ? (*calibration_.stereo)[0] : -1;
  c.stereo_right = calibration_.stereo ? (*calibration_.stereo)[1] : -1;
  c.status_sensor = Write(calibration_.status_sensor);
  c.battery_sensor = Write(calibration_.battery_sensor);

  WriteAll(mission_.gates, gates_);
  WriteAll(mission_.waypoints, waypoints_);
  c_mission_ = {Write(mission_.X_WB_start),
                mission_.start_position_sigma,
                mission_.start_yaw_sigma,
                mission_.takeoff_column_radius,
                gates_.data(),
                gates_.size(),
                mission_.gate_position_error,
                mission_.gate_angle_error,
                waypoints_.data(),
                waypoints_.size(),
                Write(mission_.target),
                Write(mission_.bounds_low),
                Write(mission_.bounds_high)};
}

void Write(std::span<const stack::Measurement> measurements, std::vector<AlulaMeasurement>& out) {
  out.clear();
  for (const stack::Measurement& measurement : measurements) {
    AlulaMeasurement& m = out.emplace_back();
    m.captured_ns = measurement.captured.ns;
    m.available_ns = measurement.available.ns;
    m.seq = measurement.seq;
    m.sensor = Write(measurement.sensor);
    std::visit(DataWriter{m}, measurement.data);
  }
}

}  // namespace alula::scenarios::plugin
