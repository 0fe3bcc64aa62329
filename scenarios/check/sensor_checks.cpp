#include "scenarios/check/sensor_checks.h"

#include "scenarios/check/camera_bench.h"
#include "scenarios/check/depth_check.h"
#include "scenarios/check/exposure_check.h"
#include "scenarios/check/frame_faults_check.h"
#include "scenarios/check/gimbal_check.h"
#include "scenarios/check/imu_errors_check.h"
#include "scenarios/check/inertia_check.h"
#include "scenarios/check/lens_check.h"
#include "scenarios/check/magnetometer_check.h"
#include "scenarios/check/photon_transfer_check.h"
#include "scenarios/check/shutter_check.h"
#include "scenarios/check/small_errors_check.h"
#include "scenarios/check/small_sensors_check.h"

namespace alula::scenarios::check {
namespace {

/// The suite with bias and white noise only: what the other errors do is measured by itself.
Rig WithoutErrors(Rig rig) {
  if (rig.sensors.imu) rig.sensors.imu->errors.reset();
  if (rig.sensors.barometer) rig.sensors.barometer->drift = 0.0;
  if (rig.sensors.position_reference) rig.sensors.position_reference->gnss.reset();
  if (auto& gnss = rig.sensors.gnss) {
    static_cast<sim::GnssConfig&>(*gnss) = {.horizontal = 0.0, .vertical = 0.0, .outages = {}};
  }
  rig.sensors.battery_gauge = {};
  return rig;
}

void CheckInertia(const Rig& rig, const sim::ImuConfig& claimed, const Told& told, Report& report) {
  told("imu: Allan deviation");
  CheckInertiaAtRest(rig, claimed, report);
  told("imu: turn-on bias");
  CheckTurnOnBias(rig, claimed, report);
  told("imu: stamps, mount, saturation");
  CheckInertiaInMotion(rig, claimed, report);
}

void CheckCameras(const Rig& rig, const CameraGroup& group, const sim::SensorsConfig& claimed, const Told& told,
                  Report& report) {
  const Rig isolated = Isolate(rig, group);
  Rig said = rig;
  said.sensors = claimed;
  const std::vector<CameraGeometry> geometry = GeometryOf(Isolate(said, group), group);
  const sim::CameraConfig& config = ConfigOf(claimed, group);
  const std::string& name = geometry.front().name;
  told(name + ": lens");
  const std::vector<CameraGeometry> measured = CheckLens(isolated, group, geometry, report);
  if (group.kind == CameraGroup::Kind::kRgbd) {
    told(name + ": depth");
    CheckDepth(isolated, group, claimed.rgbd[group.index], report);
  }
  told(name + ": photon transfer");
  CheckPhotonTransfer(isolated, config, measured, report);
  told(name + ": shutter");
  CheckShutter(isolated, group, claimed, measured, report);
  told(name + ": sub-frames");
  CheckSubFrames(isolated, group, config, geometry.front(), report);
  told(name + ": exposure control");
  CheckExposureControl(rig, group, config, report);
  told(name + ": frames on their way");
  CheckFrameFaults(rig, group, config, report);
}

}  // namespace

Report CheckSensors(const Rig& rig, const sim::SensorsConfig& claimed, const Told& told) {
  Report report;
  const Rig plain = WithoutErrors(rig);
  if (claimed.imu) {
    CheckInertia(plain, *claimed.imu, told, report);
    told("imu: scale, axes, temperature, quantum, vibration");
    CheckImuErrors(rig, *claimed.imu, report);
    if (claimed.imu->errors) report.Note("vehicle0/imu: `errors` is off where noise, mount and stamps are measured");
  }
  if (claimed.barometer) {
    told("barometer");
    CheckBarometer(plain, *claimed.barometer, report);
    told("barometer: drift, wind, ground");
    CheckBarometerErrors(rig, *claimed.barometer, report);
  }
  if (claimed.position_reference) {
    told("position reference");
    CheckPositionReference(plain, *claimed.position_reference, report);
    told("position reference: satellites");
    CheckGnss(rig, *claimed.position_reference, report);
  }
  if (claimed.gnss) {
    told("satellites");
    CheckGnssReceiver(plain, *claimed.gnss, report);
    CheckGnss(rig, *claimed.gnss, report);
  }
  if (claimed.magnetometer) {
    told("magnetometer");
    CheckMagnetometer(rig, *claimed.magnetometer, report);
  }
  told("battery");
  CheckBattery(plain, claimed, report);
  CheckBatteryGauge(rig, claimed, report);
  for (std::size_t i = 0; i < claimed.gimbals.size(); ++i) {
    told("gimbal " + claimed.gimbals[i].name);
    CheckGimbal(rig, static_cast<int>(i), claimed.gimbals[i], report);
  }
  for (const CameraGroup& group : GroupsOf(claimed)) CheckCameras(rig, group, claimed, told, report);
  return report;
}

}  // namespace alula::scenarios::check
