#include "sim/sensors/suite.h"

#include <algorithm>
#include <utility>

#include "base/error.h"
#include "sim/faults/injector.h"

namespace alula::sim {
namespace {

constexpr stack::SensorId kImu{1}, kBarometer{2}, kPositionReference{3}, kBattery{4}, kStatus{5}, kMagnetometer{6},
    kGnss{7};

}  // namespace

void Describe(base::Description& d, SensorsConfig& c) {
  d.Field("imu", c.imu, {.meaning = "inertial measurement unit"});
  d.Field("stereo", c.stereo, {.meaning = "stereo camera"});
  d.Field("cameras", c.cameras, {.meaning = "further cameras"});
  d.Field("rgbd", c.rgbd, {.meaning = "colour cameras with a structured-light depth camera beside them"});
  d.Field("gimbals", c.gimbals, {.meaning = "mounts that cameras may sit on"});
  d.Field("barometer", c.barometer, {.meaning = "barometer"});
  d.Field("position_reference", c.position_reference, {.meaning = "external position sensor (motion capture)"});
  d.Field("gnss", c.gnss, {.meaning = "receiver of satellites besides the position reference"});
  d.Field("magnetometer", c.magnetometer, {.meaning = "magnetometer"});
  d.Field("battery_rate", c.battery_rate, {.unit = "Hz", .meaning = "rate of the battery's readings"});
  d.Field("battery_noise", c.battery_noise, {.unit = "V", .meaning = "standard deviation of the voltage", .min = 0});
  d.Field("battery_gauge", c.battery_gauge, {.meaning = "what the gauge reads wrongly besides that"});
  d.Field("status_rate", c.status_rate, {.unit = "Hz", .meaning = "rate of the autopilot's reports"});
}

void Describe(base::Description& d, AutopilotSensorsConfig& c) {
  d.Field("imu", c.imu, {.meaning = "the autopilot's own; its rate must be that of the physics"});
  d.Field("barometer", c.barometer, {.meaning = "the autopilot's own"});
}

stack::Calibration TrueCalibration(const SensorsConfig& config, const vehicles::VehicleBody& body,
                                   const std::string& vehicle, const MagneticFieldConfig& field) {
  stack::Calibration calibration;
  calibration.vehicle = vehicle;
  calibration.hull_radius = body.hull_radius;
  calibration.hull_half_extents = body.hull_half_extents;
  calibration.standing_height = body.standing_height;
  calibration.status_sensor = kStatus;
  calibration.battery_sensor = kBattery;
  if (config.imu) {
    const base::Vec3& a = config.imu->orientation;
    calibration.imu = {.sensor = kImu,
                       .name = vehicle + "/imu",
                       .X_BI = {base::FromYawPitchRoll(a.x(), a.y(), a.z()), config.imu->position},
                       .rate = config.imu->rate,
                       .noise = config.imu->noise};
  }
  if (config.barometer) {
    calibration.barometer = {.sensor = kBarometer, .name = vehicle + "/barometer", .noise = config.barometer->noise};
  }
  if (config.position_reference) {
    calibration.position_reference = {.sensor = kPositionReference, .name = vehicle + "/position_reference"};
  }
  if (config.gnss) calibration.gnss = {.sensor = kGnss, .name = vehicle + "/gnss"};
  if (config.magnetometer) {
    const base::Vec3& a = config.magnetometer->orientation;
    calibration.magnetometer = {.sensor = kMagnetometer,
                                .name = vehicle + "/magnetometer",
                                .q_BM = base::FromYawPitchRoll(a.x(), a.y(), a.z()),
                                .rate = config.magnetometer->rate,
                                .noise = config.magnetometer->noise,
                                .B_W = FluxDensity(field)};
  }
  AddCameras(config, vehicle, calibration);
  return calibration;
}

SensorSuite::SensorSuite(const SensorsConfig& config, const vehicles::VehicleBody& body, base::Duration step,
                         std::uint64_t seed, const std::string& vehicle, render::CameraRenderer* renderer, int workers,
                         const worlds::Light& light, const worlds::ActorSimulation* actors)
    : config_(config),
      step_(step),
      battery_stream_(seed, vehicle + "/battery"),
      current_stream_(seed, vehicle + "/battery.current") {
  battery_clock_.rate = config.battery_rate;
  status_clock_.rate = config.status_rate;
  if (config.imu) {
    imu_.emplace(*config.imu, step, seed, vehicle + "/imu");
    imu_clock_.rate = config.imu->rate;
  }
  if (config.barometer) {
    barometer_.emplace(*config.barometer, seed, vehicle + "/barometer");
    barometer_clock_.rate = config.barometer->rate;
  }
  if (config.position_reference) {
    position_reference_.emplace(*config.position_reference, seed, vehicle + "/position_reference");
    position_clock_.rate = config.position_reference->rate;
  }
  if (config.gnss) {
    gnss_.emplace(ReferenceOf(*config.gnss), seed, vehicle + "/gnss");
    gnss_clock_.rate = config.gnss->rate;
  }
  if (config.magnetometer) {
    magnetometer_.emplace(*config.magnetometer, seed, vehicle + "/magnetometer");
    magnetometer_clock_.rate = config.magnetometer->rate;
  }
  if (HasCameras(config) || !config.gimbals.empty()) {
    if (HasCameras(config) && renderer == nullptr) throw base::FaultError("no_renderer", "cameras need a renderer");
    std::vector<base::Transform> X_BP;
    if (SeesVehicle(config)) {
      for (const vehicles::Part& part : body.parts) X_BP.push_back(part.X_BP);
    }
    std::vector<render::CameraRenderer*> renderers{renderer};
    if (workers >= 2 && renderer != nullptr) {
      twin_ = renderer->Twin();
      renderers.push_back(twin_.get());
    }
    cameras_ = std::make_unique<CameraSuite>(config, TrueCalibration(config, body, vehicle), seed, std::move(X_BP),
                                             light, std::move(renderers), workers >= 2, actors);
  }
}

SensorSuite::~SensorSuite() = default;

void SensorSuite::Settle(const vehicles::BodyState& state) {
  if (imu_) imu_->Settle(state);
  if (cameras_) cameras_->Settle({0}, state);
}

void SensorSuite::Obey(const stack::GimbalSetpoint& setpoint) {
  if (!cameras_) throw base::FaultError("stack_command", "the stack turns a gimbal of a vehicle without any");
  cameras_->Obey(setpoint);
}

void SensorSuite::Soil(const std::map<stack::SensorId, render::Dirt>& dirt) {
  if (cameras_) cameras_->Soil(dirt);
}

void SensorSuite::Integrate(base::Time t, const vehicles::BodyState& before, const vehicles::BodyState& after,
                            const Ambience& ambience) {
  if (imu_) imu_->Integrate(before, after, ambience.rotors);
  if (cameras_) cameras_->Integrate(t, after, step_);
}

void SensorSuite::Push(stack::Measurement measurement, std::optional<CameraSuite::Frame> frame) {
  faults::Numbers struck_by;
  if (injector_ != nullptr && !injector_->Take(measurement, struck_by)) return;
  const auto later = [](const stack::Measurement& a, const Pending& b) { return ArrivesBefore(b.measurement, a); };
  const auto place = std::upper_bound(pending_.begin(), pending_.end(), measurement, later);
  pending_.insert(place, {std::move(measurement), std::move(frame), std::move(struck_by)});
}

void SensorSuite::MeasureInertia(base::Time end) {
  while (imu_ && imu_clock_.Due(end)) {
    const base::Time now = imu_clock_.Next();
    const base::Time captured{now.ns - imu_->delay().ns};
    const stack::ImuSample sample = imu_->Sample(end - now);
    if (captured.ns >= 0) Push({kImu, imu_seq_++, captured, now, sample});
  }
}

void SensorSuite::MeasureCameras(const TruthWindow& truth) {
  for (CameraSuite::Frame& frame : cameras_->Measure(truth)) {
    stack::Measurement measurement = frame.measurement;
    Push(std::move(measurement), std::move(frame));
  }
  for (stack::Measurement& reading : cameras_->ReadGimbals(truth.end)) Push(std::move(reading));
}

void SensorSuite::MeasurePosition(const TruthWindow& truth, stack::SensorId sensor, base::Duration delay, Clock& clock,
                                  PositionReference& reference) {
  while (clock.Due(truth.end)) {
    const auto seq = static_cast<std::uint32_t>(clock.n);
    const base::Time now = clock.Next();
    if (const auto fix = reference.Sample(now, truth.At(now).X_WB)) Push({sensor, seq, now, now + delay, *fix});
  }
}

void SensorSuite::Measure(const TruthWindow& truth, const OwnReports& reports) {
  MeasureInertia(truth.end);
  if (cameras_) MeasureCameras(truth);
  while (barometer_ && barometer_clock_.Due(truth.end)) {
    const auto seq = static_cast<std::uint32_t>(barometer_clock_.n);
    const base::Time now = barometer_clock_.Next();
    Push({kBarometer, seq, now, now, barometer_->Sample(truth.At(now).X_WB.p.z(), truth.ambience)});
  }
  if (position_reference_) {
    MeasurePosition(truth, kPositionReference, config_.position_reference->delay, position_clock_,
                    *position_reference_);
  }
  if (gnss_) MeasurePosition(truth, kGnss, config_.gnss->delay, gnss_clock_, *gnss_);
  while (magnetometer_ && magnetometer_clock_.Due(truth.end)) {
    const auto seq = static_cast<std::uint32_t>(magnetometer_clock_.n);
    const base::Time now = magnetometer_clock_.Next();
    Push({kMagnetometer, seq, now, now,
          magnetometer_->Sample(truth.At(now).X_WB.q, truth.ambience.B_W, reports.battery.current)});
  }
  while (battery_clock_.Due(truth.end)) {
    const auto seq = static_cast<std::uint32_t>(battery_clock_.n);
    const base::Time now = battery_clock_.Next();
    Push({kBattery, seq, now, now,
          Gauge(config_.battery_gauge, reports.battery, config_.battery_noise * battery_stream_.Gaussian(),
                config_.battery_gauge.current_noise * current_stream_.Gaussian())});
  }
  while (status_clock_.Due(truth.end)) {
    const auto seq = static_cast<std::uint32_t>(status_clock_.n);
    const base::Time now = status_clock_.Next();
    Push({kStatus, seq, now, now + reports.link_delay, reports.status});
  }
}

void SensorSuite::Collect(base::Time now, std::vector<stack::Measurement>& out) {
  out.clear();
  while (!pending_.empty() && pending_.back().measurement.available <= now) {
    Pending& arrived = pending_.back();
    if (arrived.frame) {
      cameras_->Deliver(*arrived.frame);
      arrived.measurement.data = std::move(arrived.frame->measurement.data);
    }
    if (injector_ != nullptr) injector_->Arrive(arrived.measurement, arrived.struck_by);
    out.push_back(std::move(arrived.measurement));
    pending_.pop_back();
  }
}

double SensorSuite::render_ms() const { return cameras_ ? cameras_->wall_ms() : 0.0; }

}  // namespace alula::sim
