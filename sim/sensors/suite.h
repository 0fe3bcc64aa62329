#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/describe.h"
#include "sim/ambience.h"
#include "sim/faults/fault.h"
#include "sim/magnetic_field.h"
#include "sim/sensors/barometer.h"
#include "sim/sensors/battery_gauge.h"
#include "sim/sensors/camera_suite.h"
#include "sim/sensors/imu.h"
#include "sim/sensors/magnetometer.h"
#include "sim/sensors/position_reference.h"
#include "sim/truth.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"

namespace alula::sim::faults {
class Injector;
}

namespace alula::sim {

/// The sensors whose readings reach the stack.
struct SensorsConfig : CamerasConfig {
  std::optional<ImuConfig> imu = ImuConfig{};
  std::optional<BarometerConfig> barometer = BarometerConfig{};
  std::optional<PositionReferenceConfig> position_reference;
  std::optional<GnssReceiverConfig> gnss{};
  std::optional<MagnetometerConfig> magnetometer{};
  base::Rate battery_rate{10, 1};
  double battery_noise = 0.01;  // 1σ, V
  BatteryGaugeConfig battery_gauge;
  base::Rate status_rate{50, 1};
};
void Describe(base::Description& d, SensorsConfig& c);

/// The sensors that the autopilot owns.
struct AutopilotSensorsConfig {
  ImuConfig imu = AutopilotImuDefaults();
  BarometerConfig barometer;
};
void Describe(base::Description& d, AutopilotSensorsConfig& c);

/// What is true of these sensors on this vehicle, in this field; sensor ids and names are given here and nowhere else.
stack::Calibration TrueCalibration(const SensorsConfig& config, const vehicles::VehicleBody& body,
                                   const std::string& vehicle, const MagneticFieldConfig& field = {});

/// What the autopilot says of itself, and the battery, at the instant of measuring.
struct OwnReports {
  stack::BatterySample battery;
  stack::VehicleStatus status;
  base::Duration link_delay;
};

/// All sensors of one vehicle: takes samples when they are due and hands each over when it is available.
class SensorSuite {
 public:
  /// `renderer`: needed where there are cameras; made with the vehicle's parts as movers where SeesVehicle. `workers` ≥
  /// 2: pictures are drawn on two threads of their own. `light`: of the world that the renderer draws. `actors`: its
  /// actors, whose links follow the vehicle's parts among the renderer's movers; null: it has none.
  SensorSuite(const SensorsConfig& config, const vehicles::VehicleBody& body, base::Duration step, std::uint64_t seed,
              const std::string& vehicle, render::CameraRenderer* renderer, int workers,
              const worlds::Light& light = {}, const worlds::ActorSimulation* actors = nullptr);
  ~SensorSuite();

  /// From now on every measurement goes through its hands (null: none does). It outlives the suite.
  void Break(faults::Injector* injector) { injector_ = injector; }
  /// What lies on lenses from the next exposure on, besides the dirt that cameras have anyway; none: nothing.
  void Soil(const std::map<stack::SensorId, render::Dirt>& dirt);

  void Settle(const vehicles::BodyState& state);
  /// Turns a gimbal. Throws base::FaultError ("stack_command") for one that is not there.
  void Obey(const stack::GimbalSetpoint& setpoint);
  /// Every physics step (its end is `t`), for what is integrated inside.
  void Integrate(base::Time t, const vehicles::BodyState& before, const vehicles::BodyState& after,
                 const Ambience& ambience = {});
  /// Takes every sample that falls into the window (begin, end].
  void Measure(const TruthWindow& truth, const OwnReports& reports);
  /// Moves everything with available ≤ now to `out` (cleared first), in the order of stack::ArrivesBefore.
  void Collect(base::Time now, std::vector<stack::Measurement>& out);

  /// What the IMU's next sample will carry; zero without an IMU.
  ImuBias imu_bias() const { return imu_ ? ImuBias{imu_->gyro_bias(), imu_->accelerometer_bias()} : ImuBias{}; }
  /// Wall time spent on pictures by whichever thread drew them, ms.
  double render_ms() const;

 private:
  struct Clock {  // the n-th sample of a rate
    base::Rate rate;
    std::int64_t n = 0;
    bool Due(base::Time now) const { return rate.SampleTime(n) <= now; }
    base::Time Next() { return rate.SampleTime(n++); }
  };
  /// A measurement under way; a frame's picture is fetched when it arrives.
  struct Pending {
    stack::Measurement measurement;
    std::optional<CameraSuite::Frame> frame;
    faults::Numbers struck_by{};
  };
  void Push(stack::Measurement measurement, std::optional<CameraSuite::Frame> frame = std::nullopt);
  void MeasureInertia(base::Time now);
  void MeasureCameras(const TruthWindow& truth);
  void MeasurePosition(const TruthWindow& truth, stack::SensorId sensor, base::Duration delay, Clock& clock,
                       PositionReference& reference);

  SensorsConfig config_;
  base::Duration step_;
  std::optional<Imu> imu_;
  std::optional<Barometer> barometer_;
  std::optional<PositionReference> position_reference_, gnss_;
  std::optional<Magnetometer> magnetometer_;
  std::unique_ptr<render::CameraRenderer> twin_;  // for the second thread; outlives the cameras
  std::unique_ptr<CameraSuite> cameras_;
  base::RandomStream battery_stream_, current_stream_;
  Clock imu_clock_, barometer_clock_, position_clock_, gnss_clock_, magnetometer_clock_, battery_clock_, status_clock_;
  std::uint32_t imu_seq_ = 0;
  std::vector<Pending> pending_;  // the last one arrives first
  faults::Injector* injector_ = nullptr;
};

}  // namespace alula::sim
