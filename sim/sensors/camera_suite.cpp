#include "sim/sensors/camera_suite.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/nearest.h"
#include "sim/sensors/optics.h"

namespace alula::sim {
namespace {

constexpr std::uint16_t kFirstEye = 10, kFirstCamera = 100, kFirstRgbd = 200, kFirstGimbal = 300;

std::optional<int> GimbalNumber(const CamerasConfig& config, const CameraConfig& camera) {
  if (camera.gimbal.empty()) return std::nullopt;
  std::vector<std::string> names;
  for (const GimbalConfig& gimbal : config.gimbals) {
    if (gimbal.name == camera.gimbal) return static_cast<int>(names.size());
    names.push_back(gimbal.name);
  }
  const base::Origin& origin = camera.gimbal_origin;
  throw base::InputError(
      origin.where, origin.path,
      "no gimbal is called '" + camera.gimbal + "'" +
          (names.empty() ? std::string("; there is none") : "; " + base::Suggestion(camera.gimbal, names, "gimbals")));
}

stack::CameraCalibration Calibrate(const CamerasConfig& config, const CameraConfig& camera, const base::Transform& X_MC,
                                   stack::SensorId sensor, std::string name) {
  stack::CameraCalibration c;
  c.sensor = sensor;
  c.name = std::move(name);
  c.intrinsics = IntrinsicsOf(camera);
  c.rate = camera.rate;
  c.kind = camera.kind;
  c.row_delay = camera.row_delay;
  c.gimbal = GimbalNumber(config, camera);
  base::Transform X_BM;
  if (c.gimbal) X_BM.p = config.gimbals[static_cast<std::size_t>(*c.gimbal)].position;
  c.X_BC = X_BM * X_MC;
  return c;
}

void CheckNames(const stack::Calibration& calibration) {
  std::set<std::string> seen;
  const auto check = [&seen](const std::string& name) {
    if (!seen.insert(name).second) throw base::InputError("sensors: two of them are called '" + name + "'");
  };
  for (const stack::CameraCalibration& camera : calibration.cameras) check(camera.name);
  for (const stack::GimbalCalibration& gimbal : calibration.gimbals) check(gimbal.name);
}

base::Transform DepthPoseInColour(const DepthCameraConfig& config) {
  return {base::Quat::Identity(), {config.offset, 0.0, 0.0}};
}

/// The pair's calibrations: colour, then depth as the stack gets it (registered or not).
void AddRgbd(const CamerasConfig& config, const RgbdCameraConfig& camera, std::uint16_t first_id,
             const std::string& vehicle, stack::Calibration& calibration) {
  const std::string name = vehicle + "/camera." + camera.name;
  stack::CameraCalibration colour =
      Calibrate(config, camera, MountPose(camera), stack::SensorId(first_id), name + ".colour");
  stack::CameraCalibration depth = colour;
  depth.sensor = stack::SensorId(static_cast<std::uint16_t>(first_id + 1));
  depth.name = name + ".depth";
  depth.kind = stack::CameraKind::kDepth;
  depth.row_delay = {};
  if (!camera.depth.registered) {
    depth.intrinsics = DepthIntrinsicsOf(camera.depth);
    depth.X_BC = colour.X_BC * DepthPoseInColour(camera.depth);
  }
  calibration.cameras.push_back(std::move(colour));
  calibration.cameras.push_back(std::move(depth));
}

/// Share of full scale.
double MeanOf(const stack::Image& image) {
  const std::uint64_t sum = std::accumulate(image.bytes->begin(), image.bytes->end(), std::uint64_t{0});
  return static_cast<double>(sum) / (255.0 * static_cast<double>(image.bytes->size()));
}

}  // namespace

bool SeesVehicle(const CamerasConfig& config) {
  const auto sees = [](const CameraConfig& camera) { return camera.sees_vehicle; };
  return (config.stereo && config.stereo->sees_vehicle) ||
         std::any_of(config.cameras.begin(), config.cameras.end(), sees) ||
         std::any_of(config.rgbd.begin(), config.rgbd.end(), sees);
}

bool HasCameras(const CamerasConfig& config) {
  return config.stereo || !config.cameras.empty() || !config.rgbd.empty();
}

void AddCameras(const CamerasConfig& config, const std::string& vehicle, stack::Calibration& calibration) {
  if (config.stereo) {
    for (int eye = 0; eye < 2; ++eye) {
      calibration.cameras.push_back(Calibrate(config, *config.stereo, EyePose(*config.stereo, eye),
                                              stack::SensorId(kFirstEye + eye),
                                              vehicle + (eye == 0 ? "/camera.left" : "/camera.right")));
    }
    calibration.stereo = {0, 1};
  }
  for (std::size_t i = 0; i < config.cameras.size(); ++i) {
    const NamedCameraConfig& camera = config.cameras[i];
    calibration.cameras.push_back(Calibrate(config, camera, MountPose(camera),
                                            stack::SensorId(static_cast<std::uint16_t>(kFirstCamera + i)),
                                            vehicle + "/camera." + camera.name));
  }
  for (std::size_t i = 0; i < config.rgbd.size(); ++i) {
    AddRgbd(config, config.rgbd[i], static_cast<std::uint16_t>(kFirstRgbd + 2 * i), vehicle, calibration);
  }
  for (std::size_t i = 0; i < config.gimbals.size(); ++i) {
    calibration.gimbals.push_back({stack::SensorId(static_cast<std::uint16_t>(kFirstGimbal + i)),
                                   vehicle + "/gimbal." + config.gimbals[i].name, config.gimbals[i].position});
  }
  CheckNames(calibration);
}

CameraSuite::CameraSuite(const CamerasConfig& config, const stack::Calibration& calibration, std::uint64_t seed,
                         std::vector<base::Transform> X_BP, const worlds::Light& light,
                         std::vector<render::CameraRenderer*> renderers, bool threads,
                         const worlds::ActorSimulation* actors)
    : seed_(seed),
      X_BP_(std::move(X_BP)),
      light_(light),
      actors_(actors != nullptr && !actors->empty() ? actors : nullptr),
      gimbal_configs_(config.gimbals),
      gimbal_calibrations_(calibration.gimbals),
      darkroom_(std::move(renderers), threads) {
  std::size_t number = 0;
  if (config.stereo) {
    exposures_.emplace_back(*config.stereo);
    const auto lens = std::make_shared<const render::Lens>(calibration.cameras[0].intrinsics);
    for (int eye = 0; eye < 2; ++eye) {
      AddUnit(*config.stereo, calibration.cameras[number++], lens, EyePose(*config.stereo, eye));
      units_.back().meters = eye == 0;
    }
    units_.back().late = config.stereo->eye_offset;
    units_.back().late_every = config.stereo->eye_offset_every;
  }
  for (const NamedCameraConfig& camera : config.cameras) {
    exposures_.emplace_back(camera);
    const auto lens = std::make_shared<const render::Lens>(calibration.cameras[number].intrinsics);
    AddUnit(camera, calibration.cameras[number++], lens, MountPose(camera));
    units_.back().meters = true;
  }
  for (const RgbdCameraConfig& camera : config.rgbd) {
    exposures_.emplace_back(camera);
    const auto lens = std::make_shared<const render::Lens>(calibration.cameras[number].intrinsics);
    AddUnit(camera, calibration.cameras[number++], lens, MountPose(camera));
    units_.back().meters = true;
    AddDepthUnit(camera, calibration.cameras[number++]);
  }
  for (std::size_t i = 0; i < config.gimbals.size(); ++i) {
    gimbals_.emplace_back(config.gimbals[i], seed, gimbal_calibrations_[i].name);
    gimbal_clocks_.push_back({config.gimbals[i].rate});
  }
}

CameraSuite::Take CameraSuite::TakeOf(const CameraConfig& config, const stack::CameraCalibration& calibration,
                                      std::shared_ptr<const render::Lens> lens) const {
  const auto optics = std::make_shared<const Optics>(
      MakeOptics(config, calibration.intrinsics, std::move(lens), calibration.name, seed_, X_BP_, light_));
  return [optics](const Exposure& e, render::CameraRenderer& r) { return TakeImage(*optics, e, r); };
}

void CameraSuite::AddUnit(const CameraConfig& config, const stack::CameraCalibration& calibration,
                          std::shared_ptr<const render::Lens> lens, const base::Transform& X_MC) {
  Unit unit{.config = config,
            .calibration = calibration,
            .take = TakeOf(config, calibration, lens),
            .lens = lens,
            .dirt = config.dirt,
            .X_MC = X_MC,
            .gimbal = calibration.gimbal ? std::optional<std::size_t>(*calibration.gimbal) : std::nullopt,
            .exposure = exposures_.size() - 1,
            .faults = FrameFaults(config.faults, seed_, calibration.name),
            .clock = {config.rate},
            .opened = {},
            .last = {}};
  units_.push_back(std::move(unit));
}

void CameraSuite::AddDepthUnit(const RgbdCameraConfig& config, const stack::CameraCalibration& calibration) {
  const Unit& colour = units_.back();
  DepthOptics optics{config.depth,
                     DepthIntrinsicsOf(config.depth),
                     std::nullopt,
                     DepthPoseInColour(config.depth),
                     calibration.name,
                     seed_,
                     X_BP_};
  if (config.depth.registered) optics.registered = calibration.intrinsics;
  const auto shared = std::make_shared<const DepthOptics>(std::move(optics));
  Unit unit = colour;
  unit.config.motion_blur = false;
  unit.config.row_delay = {};
  unit.config.read_out = config.depth.read_out;
  unit.calibration = calibration;
  unit.take = [shared](const Exposure& e, render::CameraRenderer& r) { return TakeDepth(*shared, e, r); };
  unit.lens = nullptr;
  unit.meters = false;
  unit.faults = FrameFaults(config.faults, seed_, calibration.name);
  units_.push_back(std::move(unit));
}

void CameraSuite::Settle(base::Time t, const vehicles::BodyState& state) {
  for (Gimbal& gimbal : gimbals_) gimbal.Settle(t, state);
}

void CameraSuite::Integrate(base::Time t, const vehicles::BodyState& state, base::Duration dt) {
  for (Gimbal& gimbal : gimbals_) gimbal.Step(t, state, dt);
}

void CameraSuite::Obey(const stack::GimbalSetpoint& setpoint) {
  if (setpoint.gimbal < 0 || static_cast<std::size_t>(setpoint.gimbal) >= gimbals_.size()) {
    throw base::FaultError("stack_command", "the stack turns gimbal " + std::to_string(setpoint.gimbal) + " of " +
                                                std::to_string(gimbals_.size()));
  }
  gimbals_[static_cast<std::size_t>(setpoint.gimbal)].Want(setpoint);
}

void CameraSuite::Soil(const std::map<stack::SensorId, render::Dirt>& dirt) {
  for (Unit& unit : units_) {
    const auto found = dirt.find(unit.calibration.sensor);
    const render::Dirt now = found == dirt.end() ? unit.config.dirt : render::Together(unit.config.dirt, found->second);
    if (unit.lens == nullptr || now == unit.dirt) continue;
    CameraConfig config = unit.config;
    config.dirt = unit.dirt = now;
    unit.take = TakeOf(config, unit.calibration, unit.lens);
  }
}

Instant CameraSuite::At(const Unit& unit, base::Time t) const {
  const base::Transform X_WB = motion_.At(t).X_WB;
  const base::Transform X_WM = unit.gimbal ? X_WB * gimbals_[*unit.gimbal].At(t) : X_WB;
  return {X_WM * unit.X_MC, X_WB, t};
}

void CameraSuite::Open(Unit& unit, base::Time now) {
  const ExposureSetting setting = exposures_[unit.exposure].Current();
  const base::Duration half = HalfSpan(unit.config, setting.length);
  while (unit.clock.rate.SampleTime(unit.clock.n) - half <= now) {
    unit.opened.push_back(
        {static_cast<std::uint32_t>(unit.clock.n), unit.clock.rate.SampleTime(unit.clock.n), setting});
    ++unit.clock.n;
  }
}

bool CameraSuite::IsOver(const Unit& unit, const Opened& opened, base::Time now) const {
  const bool instant = !unit.config.motion_blur && unit.config.row_delay.ns == 0;  // what comes after is not seen
  const base::Duration half = instant ? base::Duration{} : HalfSpan(unit.config, opened.setting.length);
  const bool late = opened.seq % static_cast<std::uint32_t>(unit.late_every) == 0 && unit.late.ns > 0;
  return opened.captured + half + (late ? unit.late : base::Duration{}) <= now;
}

std::optional<CameraSuite::Frame> CameraSuite::Close(std::size_t number, const Opened& opened) {
  Unit& unit = units_[number];
  const FrameFate fate = unit.faults.Next();
  if (fate.dropped) return std::nullopt;
  Frame frame;
  frame.measurement = {unit.calibration.sensor, opened.seq, opened.captured,
                       opened.captured + unit.config.read_out + fate.late_by, stack::Image{}};
  frame.camera = number;
  frame.setting = opened.setting;
  if (fate.frozen && unit.last) return frame;
  const bool late = opened.seq % static_cast<std::uint32_t>(unit.late_every) == 0;
  const base::Time middle = late ? opened.captured + unit.late : opened.captured;
  auto exposure = std::make_shared<Exposure>(Plan(unit, opened, middle));
  frame.print = darkroom_.Request(
      [take = unit.take, exposure](render::CameraRenderer& renderer) { return take(*exposure, renderer); });
  return frame;
}

Exposure CameraSuite::Plan(const Unit& unit, const Opened& opened, base::Time middle) const {
  const auto at = [&](base::Time t) { return At(unit, t); };
  constexpr double kStep = 0.75;  // px
  const double seen_speed = actors_ != nullptr ? actors_->AngularSpeed(at(middle).X_WC.p) : 0.0;
  Exposure exposure =
      PlanExposure(unit.config, unit.calibration.intrinsics.fx, opened.setting, middle, at, kStep, seen_speed);
  exposure.seq = opened.seq;
  exposure.captured = opened.captured;
  for (Exposure::Slice& slice : exposure.slices) {
    for (Instant& instant : slice.instants) {
      if (actors_ != nullptr) instant.X_WL = actors_->LinkPoses(instant.time);
    }
  }
  return exposure;
}

std::vector<CameraSuite::Frame> CameraSuite::Measure(const TruthWindow& truth) {
  motion_.Add(truth);
  std::vector<Frame> frames;
  for (std::size_t i = 0; i < units_.size(); ++i) {
    Unit& unit = units_[i];
    Open(unit, truth.end);
    while (!unit.opened.empty() && IsOver(unit, unit.opened.front(), truth.end)) {
      if (std::optional<Frame> frame = Close(i, unit.opened.front())) frames.push_back(std::move(*frame));
      unit.opened.pop_front();
    }
  }
  return frames;
}

void CameraSuite::Deliver(Frame& frame) {
  Unit& unit = units_[frame.camera];
  if (frame.print != nullptr) unit.last = darkroom_.Fetch(frame.print);
  std::visit(
      [&](const auto& picture) {
        auto delivered = picture;
        delivered.exposure_start = frame.measurement.captured + base::Nanoseconds(-frame.setting.length.ns / 2);
        frame.measurement.data = std::move(delivered);
      },
      *unit.last);
  const auto* image = std::get_if<stack::Image>(&frame.measurement.data);
  if (unit.meters && unit.config.auto_exposure && image != nullptr && frame.print != nullptr) {
    exposures_[unit.exposure].See(MeanOf(*image), frame.setting);
  }
}

std::vector<stack::Measurement> CameraSuite::ReadGimbals(base::Time now) {
  std::vector<stack::Measurement> readings;
  for (std::size_t i = 0; i < gimbals_.size(); ++i) {
    Clock& clock = gimbal_clocks_[i];
    while (clock.rate.SampleTime(clock.n) <= now) {
      const base::Time t = clock.rate.SampleTime(clock.n);
      readings.push_back(
          {gimbal_calibrations_[i].sensor, static_cast<std::uint32_t>(clock.n), t, t, gimbals_[i].Sample()});
      ++clock.n;
    }
  }
  return readings;
}

}  // namespace alula::sim
