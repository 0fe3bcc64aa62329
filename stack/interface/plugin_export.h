#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/error.h"
#include "stack/interface/calibration.h"
#include "stack/interface/mission.h"
#include "stack/interface/navigation_stack.h"
#include "stack/interface/plugin.h"

/// A NavigationStack as a shared library in one line:
///
///   std::unique_ptr<NavigationStack> Make(const Calibration&, const Mission&, std::uint64_t seed, int workers,
///                                         std::string_view parameters);
///   ALULA_EXPORT_STACK(Make)
///
/// Exceptions become error returns here: base::InputError of the maker is bad input, all others are faults of the
/// stack. What a stack shows of its inside (StackView) does not cross.
namespace alula::stack::plugin {

// From the structs of plugin.h, bit by bit.

inline std::string Read(const AlulaText& t) { return {t.bytes, static_cast<std::size_t>(t.size)}; }
inline base::Vec3 Read(const AlulaVec3& v) { return {v.x, v.y, v.z}; }
inline base::Quat Read(const AlulaQuat& q) { return {q.w, q.x, q.y, q.z}; }
inline base::Transform Read(const AlulaTransform& X) { return {Read(X.q), Read(X.p)}; }

inline CameraCalibration Read(const AlulaCameraCalibration& c) {
  CameraCalibration camera;
  camera.sensor = SensorId{c.sensor};
  camera.name = Read(c.name);
  camera.intrinsics = {.width = c.width, .height = c.height, .fx = c.fx, .fy = c.fy, .cx = c.cx, .cy = c.cy};
  std::copy(std::begin(c.distortion), std::end(c.distortion), camera.intrinsics.distortion.begin());
  camera.intrinsics.model = static_cast<DistortionModel>(c.model);
  camera.X_BC = Read(c.X_BC);
  camera.rate = {c.rate_cycles, c.rate_seconds};
  camera.time_offset = {c.time_offset_ns};
  camera.kind = static_cast<CameraKind>(c.kind);
  camera.row_delay = {c.row_delay_ns};
  if (c.gimbal >= 0) camera.gimbal = c.gimbal;
  return camera;
}

inline ImuCalibration Read(const AlulaImuCalibration& i) {
  return {SensorId{i.sensor},
          Read(i.name),
          Read(i.X_BI),
          {i.rate_cycles, i.rate_seconds},
          {i.gyro_noise, i.accelerometer_noise, i.gyro_bias_walk, i.accelerometer_bias_walk, i.gyro_turn_on_bias,
           i.accelerometer_turn_on_bias, i.gyro_range, i.accelerometer_range}};
}

inline Calibration Read(const AlulaCalibration& c) {
  Calibration calibration;
  calibration.vehicle = Read(c.vehicle);
  for (std::uint64_t i = 0; i < c.camera_count; ++i) calibration.cameras.push_back(Read(c.cameras[i]));
  if (c.stereo_left >= 0) calibration.stereo = {c.stereo_left, c.stereo_right};
  for (std::uint64_t i = 0; i < c.gimbal_count; ++i) {
    calibration.gimbals.push_back({SensorId{c.gimbals[i].sensor}, Read(c.gimbals[i].name), Read(c.gimbals[i].p_BG)});
  }
  if (c.imu != nullptr) calibration.imu = Read(*c.imu);
  if (const auto* b = c.barometer) calibration.barometer = {SensorId{b->sensor}, Read(b->name), b->noise};
  if (const auto* p = c.position_reference) calibration.position_reference = {SensorId{p->sensor}, Read(p->name)};
  if (const auto* g = c.gnss) calibration.gnss = {SensorId{g->sensor}, Read(g->name)};
  if (const auto* m = c.magnetometer) {
    calibration.magnetometer = {
        SensorId{m->sensor}, Read(m->name), Read(m->q_BM), {m->rate_cycles, m->rate_seconds}, m->noise, Read(m->B_W)};
  }
  calibration.status_sensor = SensorId{c.status_sensor};
  calibration.battery_sensor = SensorId{c.battery_sensor};
  calibration.hull_radius = c.hull_radius;
  calibration.hull_half_extents = Read(c.hull_half_extents);
  calibration.standing_height = c.standing_height;
  return calibration;
}

inline Mission Read(const AlulaMission& m) {
  Mission mission;
  mission.X_WB_start = Read(m.X_WB_start);
  mission.start_position_sigma = m.start_position_sigma;
  mission.start_yaw_sigma = m.start_yaw_sigma;
  mission.takeoff_column_radius = m.takeoff_column_radius;
  for (std::uint64_t i = 0; i < m.gate_count; ++i) {
    mission.gates.push_back({Read(m.gates[i].name), Read(m.gates[i].X_WG), m.gates[i].opening});
  }
  mission.gate_position_error = m.gate_position_error;
  mission.gate_angle_error = m.gate_angle_error;
  for (std::uint64_t i = 0; i < m.waypoint_count; ++i) mission.waypoints.push_back(Read(m.waypoints[i]));
  mission.target = Read(m.target);
  mission.bounds_low = Read(m.bounds_low);
  mission.bounds_high = Read(m.bounds_high);
  return mission;
}

/// Copies the pixels: those of `i` live for one call.
inline Image Read(const AlulaImage& i) {
  return {static_cast<PixelFormat>(i.format),
          i.width,
          i.height,
          i.stride,
          {i.exposure_start_ns},
          {i.exposure_ns},
          i.gain,
          std::make_shared<const std::vector<std::uint8_t>>(i.bytes, i.bytes + i.size)};
}
inline DepthImage Read(const AlulaDepthImage& i) {
  return {i.width,
          i.height,
          {i.exposure_start_ns},
          {i.exposure_ns},
          std::make_shared<const std::vector<std::uint16_t>>(i.millimetres, i.millimetres + i.count)};
}

inline Measurement Read(const AlulaMeasurement& m) {
  const auto data = [&]() -> decltype(Measurement::data) {
    const auto& d = m.data;
    switch (m.kind) {
      case ALULA_IMU:
        return ImuSample{Read(d.imu.angular_velocity), Read(d.imu.specific_force)};
      case ALULA_IMAGE:
        return Read(d.image);
      case ALULA_BARO:
        return BaroSample{d.baro.pressure};
      case ALULA_POSITION_FIX:
        return PositionFix{Read(d.position_fix.X_WB), d.position_fix.position_sigma, d.position_fix.attitude_sigma};
      case ALULA_BATTERY:
        return BatterySample{d.battery.voltage, d.battery.current};
      case ALULA_VEHICLE_STATUS:
        return VehicleStatus{static_cast<VehicleStatus::Mode>(d.status.mode), d.status.armed != 0,
                             d.status.ready_to_arm != 0, d.status.landed != 0, d.status.thrust};
      case ALULA_DEPTH_IMAGE:
        return Read(d.depth_image);
      case ALULA_GIMBAL_ANGLES:
        return GimbalAngles{d.gimbal.roll, d.gimbal.pitch, d.gimbal.yaw};
      case ALULA_MAG:
        return MagSample{Read(d.mag.magnetic_field)};
      default:
        throw std::runtime_error("a measurement of the unknown kind " + std::to_string(m.kind));
    }
  };
  return {SensorId{m.sensor}, m.seq, {m.captured_ns}, {m.available_ns}, data()};
}

// Into the structs of plugin.h. Texts and bytes are pointed to, not copied.

inline AlulaText Write(const std::string& text) { return {text.data(), text.size()}; }
inline AlulaVec3 Write(const base::Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline AlulaTransform Write(const base::Transform& X) {
  return {{X.q.w(), X.q.x(), X.q.y(), X.q.z()}, {X.p.x(), X.p.y(), X.p.z()}};
}

inline AlulaCommand Write(const Command& command) {
  AlulaCommand c{};
  c.issued_ns = command.issued.ns;
  c.expires_ns = command.expires.ns;
  const auto write = [&c](const auto& what) {
    using What = std::decay_t<decltype(what)>;
    if constexpr (std::is_same_v<What, Arm>) {
      c.kind = ALULA_ARM;
    } else if constexpr (std::is_same_v<What, Disarm>) {
      c.kind = ALULA_DISARM;
    } else if constexpr (std::is_same_v<What, PositionSetpoint>) {
      c.kind = ALULA_POSITION_SETPOINT;
      c.data.position = {Write(what.p_OB), Write(what.v_OB), Write(what.a_OB), what.yaw, what.yaw_rate};
    } else if constexpr (std::is_same_v<What, VelocitySetpoint>) {
      c.kind = ALULA_VELOCITY_SETPOINT;
      c.data.velocity = {Write(what.v_OB), what.yaw, what.yaw_rate};
    } else if constexpr (std::is_same_v<What, Hold>) {
      c.kind = ALULA_HOLD;
    } else if constexpr (std::is_same_v<What, Land>) {
      c.kind = ALULA_LAND;
    } else {
      static_assert(std::is_same_v<What, GimbalSetpoint>);
      c.kind = ALULA_GIMBAL_SETPOINT;
      c.data.gimbal = {what.roll, what.pitch, what.yaw, what.gimbal, 0};
    }
  };
  std::visit(write, command.what);
  return c;
}

inline AlulaEstimate Write(const Estimate& estimate) {
  AlulaEstimate e{};
  e.stamp_ns = estimate.stamp.ns;
  e.X_OB = Write(estimate.X_OB);
  e.v_OB = Write(estimate.v_OB);
  e.w_B = Write(estimate.w_B);
  for (int i = 0; i < 36; ++i) e.pose_covariance[i] = estimate.pose_covariance(i / 6, i % 6);
  for (int i = 0; i < 9; ++i) e.velocity_covariance[i] = estimate.velocity_covariance(i / 3, i % 3);
  e.X_MO = Write(estimate.X_MO);
  e.reset_counter = estimate.reset_counter;
  return e;
}

/// One stack of the library, with what its last answer points to.
struct Exported {
  std::unique_ptr<NavigationStack> stack;
  std::vector<Measurement> measurements;
  StackOutput output;
  std::vector<AlulaCommand> commands;
  std::vector<AlulaEvent> events;
  AlulaEstimate estimate{};
  std::vector<StackFile> stack_files;
  std::vector<AlulaFile> files;
  std::vector<StageTime> stage_times;
  std::vector<AlulaStageTime> stages;
};

inline void Step(Exported& self, base::Time now, const AlulaMeasurement* measurements, std::uint64_t count,
                 AlulaOutput& o) {
  self.measurements.clear();
  for (std::uint64_t i = 0; i < count; ++i) self.measurements.push_back(Read(measurements[i]));
  self.output = self.stack->Step(now, self.measurements);
  self.commands.clear();
  for (const Command& command : self.output.commands) self.commands.push_back(Write(command));
  self.events.clear();
  for (const StackEvent& event : self.output.events) {
    self.events.push_back({event.time.ns, Write(event.kind), Write(event.text)});
  }
  if (self.output.estimate) self.estimate = Write(*self.output.estimate);
  o.commands = self.commands.data();
  o.command_count = self.commands.size();
  o.events = self.events.data();
  o.event_count = self.events.size();
  o.estimate = self.output.estimate ? &self.estimate : nullptr;
  o.state = static_cast<std::uint32_t>(self.output.state);
  o.next_gate = self.output.next_gate;
}

inline void Files(Exported& self, AlulaFiles& files) {
  self.stack_files = self.stack->Files();
  self.files.clear();
  for (const StackFile& file : self.stack_files) {
    self.files.push_back(
        {Write(file.name), reinterpret_cast<const std::uint8_t*>(file.bytes.data()), file.bytes.size()});
  }
  files = {self.files.data(), self.files.size()};
}

inline void Timing(Exported& self, AlulaTiming& timing) {
  self.stage_times = self.stack->Timing();
  self.stages.clear();
  for (const StageTime& stage : self.stage_times) {
    self.stages.push_back({Write(stage.name), stage.wall_ms, stage.calls, stage.p99_ms});
  }
  timing = {self.stages.data(), self.stages.size()};
}

/// Runs `work`; what it throws becomes an answer and a text.
template <typename Work>
std::int32_t Guarded(AlulaError* error, const Work& work) noexcept {
  const auto say = [error](std::string_view text) {
    const std::size_t size = std::min(text.size(), sizeof error->text - 1);
    std::memcpy(error->text, text.data(), size);
    error->text[size] = '\0';
  };
  try {
    work();
    return ALULA_OK;
  } catch (const base::InputError& e) {
    say(e.what());
    return ALULA_BAD_INPUT;
  } catch (const std::exception& e) {
    say(e.what());
  } catch (...) {
    say("the stack threw something that is no std::exception");
  }
  return ALULA_FAILED;
}

inline std::int32_t SetComputeFactor(void* self, double factor) {
  return static_cast<Exported*>(self)->stack->SetComputeFactor(factor) ? 1 : 0;
}

/// The table of functions around `kMake`.
template <auto kMake>
AlulaStackPlugin TableOf(const char* name) {
  AlulaStackPlugin table = {ALULA_STACK_ABI_VERSION, 0, ALULA_LAYOUT, name, {}, {}, {}, {}, {}};
  table.create = [](const AlulaSetup* setup, void** self, AlulaError* error) {
    return Guarded(error, [&] {
      auto exported = std::make_unique<Exported>();
      const std::string parameters = Read(setup->parameters);
      exported->stack =
          kMake(Read(*setup->calibration), Read(*setup->mission), setup->seed, setup->workers, parameters);
      if (!exported->stack) throw std::runtime_error("the maker returned no stack");
      *self = exported.release();
    });
  };
  table.step = [](void* self, std::int64_t now_ns, const AlulaMeasurement* measurements, std::uint64_t count,
                  AlulaOutput* output, AlulaError* error) {
    return Guarded(error, [&] { Step(*static_cast<Exported*>(self), {now_ns}, measurements, count, *output); });
  };
  table.files = [](void* self, AlulaFiles* files, AlulaError* error) {
    return Guarded(error, [&] { Files(*static_cast<Exported*>(self), *files); });
  };
  table.timing = [](void* self, AlulaTiming* timing, AlulaError* error) {
    return Guarded(error, [&] { Timing(*static_cast<Exported*>(self), *timing); });
  };
  table.destroy = [](void* self) { delete static_cast<Exported*>(self); };
  return table;
}

}  // namespace alula::stack::plugin

/// Exports the stack that `maker` (a function, see the top of this file) makes. Once per library, outside of
/// namespaces.
#define ALULA_EXPORT_STACK(maker)                                                               \
  extern "C" ALULA_STACK_EXPORT const AlulaStackPlugin* alula_stack_plugin(void) {              \
    static const AlulaStackPlugin table = alula::stack::plugin::TableOf<maker>(#maker);         \
    return &table;                                                                              \
  }                                                                                             \
  extern "C" ALULA_STACK_EXPORT int32_t alula_stack_compute_factor(void* self, double factor) { \
    return alula::stack::plugin::SetComputeFactor(self, factor);                                \
  }
