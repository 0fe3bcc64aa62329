#include "sim/faults/scope.h"

namespace alula::sim::faults {

Scope ScopeOf(const SensorsConfig& sensors, const vehicles::VehicleModel& vehicle, const worlds::World& world,
              const std::string& vehicle_id, bool autopilot, bool stack) {
  Scope scope{{}, vehicle.Motors(), static_cast<int>(world.gates.size()), autopilot, stack};
  const auto add = [&](const std::string& name, stack::SensorId id, decltype(stack::Measurement::data) sample) {
    scope.sensors.push_back({name, id, std::move(sample)});
  };
  const auto plain = [&](const std::string& name) {
    return name.starts_with(vehicle_id + "/") ? name.substr(vehicle_id.size() + 1) : name;
  };
  const stack::Calibration known = TrueCalibration(sensors, vehicle.body(), vehicle_id);
  if (known.imu) add(plain(known.imu->name), known.imu->sensor, stack::ImuSample{});
  for (const stack::CameraCalibration& camera : known.cameras) {
    const bool depth = camera.kind == stack::CameraKind::kDepth;
    if (depth) {
      add(plain(camera.name), camera.sensor, stack::DepthImage{});
    } else {
      add(plain(camera.name), camera.sensor, stack::Image{});
    }
  }
  for (const stack::GimbalCalibration& gimbal : known.gimbals) {
    add(plain(gimbal.name), gimbal.sensor, stack::GimbalAngles{});
  }
  if (known.barometer) add(plain(known.barometer->name), known.barometer->sensor, stack::BaroSample{});
  if (known.position_reference) {
    add(plain(known.position_reference->name), known.position_reference->sensor, stack::PositionFix{});
  }
  if (known.gnss) add(plain(known.gnss->name), known.gnss->sensor, stack::PositionFix{});
  if (known.magnetometer) add(plain(known.magnetometer->name), known.magnetometer->sensor, stack::MagSample{});
  add("battery", known.battery_sensor, stack::BatterySample{});
  add("status", known.status_sensor, stack::VehicleStatus{});
  if (autopilot) {
    add("autopilot.imu", kAutopilotImu, stack::ImuSample{});
    add("autopilot.barometer", kAutopilotBarometer, stack::BaroSample{});
    add("autopilot.battery", kAutopilotBattery, stack::BatterySample{});
  }
  return scope;
}

}  // namespace alula::sim::faults
