#include "sim/sensors/camera_config.h"

#include <algorithm>
#include <cmath>

#include "stack/interface/camera_model.h"

namespace alula::sim {
namespace {

std::size_t LargestCount(stack::DistortionModel model) {
  return model == stack::DistortionModel::kRadialTangential ? 5 : 4;
}

std::string WrongOptics(const CameraConfig& c) {
  constexpr const char* kFolded =
      "reaches beyond where the lens coefficients fold the picture back; it must be smaller";
  if (c.lens.coefficients.size() > LargestCount(c.lens.model)) {
    return "the lens model has no more than " + std::to_string(LargestCount(c.lens.model)) + " coefficients";
  }
  const bool fisheye = c.lens.model == stack::DistortionModel::kEquidistant;
  if (!fisheye && c.fov > 2.8)
    return "is too wide for this lens model; above 2.8 rad (160 deg) use an equidistant lens";
  const stack::CameraIntrinsics k = IntrinsicsOf(c);
  if (!(k.fx > 1.0) || !std::isfinite(k.fx)) return "cannot be reached with these lens coefficients";
  const double largest = stack::LargestAngle(k);
  if (0.5 * c.fov > largest) return kFolded;
  for (const base::Vec2& corner : {base::Vec2(0, 0), base::Vec2(k.width - 1, 0), base::Vec2(0, k.height - 1),
                                   base::Vec2(k.width - 1, k.height - 1)}) {
    const base::Vec3 ray = stack::Ray(k, corner);
    const bool there = ray.allFinite() && (stack::Project(k, ray) - corner).norm() < 0.01;
    if (!there || std::acos(std::clamp(ray.z(), -1.0, 1.0)) > largest) return kFolded;
  }
  return {};
}

std::string WrongTimes(const CameraConfig& c, base::Duration late = {}) {
  const base::Duration longest = c.auto_exposure ? std::max(c.auto_exposure->longest, c.exposure) : c.exposure;
  const std::int64_t half = longest.ns / 2 + c.row_delay.ns * (c.height - 1) / 2;
  if (c.read_out.ns < half + late.ns) {
    return "must be at least half the exposure, half the rolling of the rows and the eye's offset: " +
           std::to_string((half + late.ns + 999) / 1000) + " us";
  }
  if (2 * half > static_cast<std::int64_t>(c.rate.Period() * 1e9)) {
    return "exposure and rolling of the rows do not fit into the time of a frame";
  }
  return {};
}

}  // namespace

void Describe(base::Description& d, LensConfig& c) {
  d.Field("model", c.model, {.meaning = "of the distortion", .choices = {"radial_tangential", "equidistant"}});
  d.Field("coefficients", c.coefficients,
          {.unit = "1", .meaning = "k1 k2 p1 p2 k3 or k1 k2 k3 k4 (OpenCV's order)", .min = -100, .max = 100});
}

void Describe(base::Description& d, AutoExposureConfig& c) {
  d.Field("target", c.target,
          {.unit = "1", .meaning = "mean of the picture, share of full scale", .min = 0.02, .max = 0.9});
  d.Field("speed", c.speed,
          {.unit = "1", .meaning = "share of the error in stops mended a frame", .min = 0.01, .max = 1});
  d.Field("delay", c.delay, {.unit = "1", .meaning = "frames until a measurement is obeyed", .min = 1, .max = 30});
  d.Field("shortest", c.shortest, {.unit = "s", .meaning = "exposure", .min = 1e-6, .max = 1});
  d.Field("longest", c.longest, {.unit = "s", .meaning = "exposure", .min = 1e-6, .max = 1});
  d.Field("largest_gain", c.largest_gain, {.unit = "1", .meaning = "against the least", .min = 1, .max = 64});
  d.Check("longest", [&c] {
    return c.longest < c.shortest ? std::string("is below shortest; must be at least that") : std::string();
  });
}

void Describe(base::Description& d, FrameFaultsConfig& c) {
  d.Field("drop", c.drop, {.unit = "1", .meaning = "share of frames that never arrive", .min = 0, .max = 1});
  d.Field("late", c.late, {.unit = "1", .meaning = "share of frames that arrive late", .min = 0, .max = 1});
  d.Field("late_by", c.late_by, {.unit = "s", .meaning = "at most, uniformly", .min = 0, .max = 10});
  d.Field("freeze", c.freeze,
          {.unit = "1", .meaning = "share of frames at which the camera gets stuck", .min = 0, .max = 1});
  d.Field("freeze_frames", c.freeze_frames,
          {.unit = "1", .meaning = "so many frames show the one before", .min = 1, .max = 100000});
}

void Describe(base::Description& d, CameraConfig& c) {
  d.Field("kind", c.kind, {.meaning = "what it delivers", .choices = {"grey", "colour", "infrared"}});
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "frames a second"});
  d.Field("width", c.width, {.unit = "1", .meaning = "pixels a row", .min = 16, .max = 4096});
  d.Field("height", c.height, {.unit = "1", .meaning = "rows", .min = 16, .max = 4096});
  d.Field("fov", c.fov, {.unit = "rad", .meaning = "field of view across the middle row", .min = 0.05, .max = 4});
  d.Field("lens", c.lens, {.meaning = "distortion"});
  d.Field("position", c.position, {.unit = "m", .meaning = "in the mount: the body, or the gimbal"});
  d.Field("yaw", c.yaw,
          {.unit = "rad", .meaning = "optical axis to the left of the mount's x axis", .min = -3.2, .max = 3.2});
  d.Field("pitch", c.pitch,
          {.unit = "rad", .meaning = "optical axis below the mount's horizon", .min = -1.6, .max = 1.6});
  d.Field("roll", c.roll, {.unit = "rad", .meaning = "about the optical axis", .min = -3.2, .max = 3.2});
  d.Field("gimbal", c.gimbal,
          {.meaning = "name of the gimbal that it sits on; none: the body", .origin = &c.gimbal_origin});
  d.Field(
      "exposure", c.exposure,
      {.unit = "s", .meaning = "length that the light is set for; stamps are of its middle", .min = 1e-6, .max = 1});
  d.Field("auto_exposure", c.auto_exposure, {.meaning = "follows the light"});
  d.Field("motion_blur", c.motion_blur, {.meaning = "pictures are integrated over the exposure"});
  d.Field("row_delay", c.row_delay,
          {.unit = "s", .meaning = "rolling shutter, from one row to the next", .min = 0, .max = 1e-3});
  d.Field("read_out", c.read_out,
          {.unit = "s", .meaning = "from the middle of the exposure to the stack", .min = 0, .max = 10});
  d.Field("lamps", c.lamps, {.meaning = "that ride with it, in camera axes (x right, y down, z forward)"});
  d.Field("sees_vehicle", c.sees_vehicle, {.meaning = "the vehicle itself is drawn"});
  Describe(d, static_cast<render::SensorEffects&>(c));
  d.Field("faults", c.faults, {.meaning = "what happens to frames on the way"});
  d.Check("lamps", [&c] { return c.lamps.size() > 8 ? std::string("are more than 8") : std::string(); });
  d.Check("fov", [&c] { return WrongOptics(c); });
  d.Check("read_out", [&c] { return WrongTimes(c); });
}

void Describe(base::Description& d, NamedCameraConfig& c) {
  d.Field("name", c.name, {.meaning = "of the sensor: vehicle0/camera.<name>", .required = true});
  Describe(d, static_cast<CameraConfig&>(c));
}

void Describe(base::Description& d, StereoCameraConfig& c) {
  Describe(d, static_cast<CameraConfig&>(c));
  d.Field("baseline", c.baseline, {.unit = "m", .meaning = "distance between the eyes", .min = 0.005, .max = 2});
  d.Field(
      "eye_offset", c.eye_offset,
      {.unit = "s", .meaning = "the right eye exposes so much later than its stamp says", .min = -0.05, .max = 0.05});
  d.Field("eye_offset_every", c.eye_offset_every,
          {.unit = "1", .meaning = "the offset strikes every n-th frame", .min = 1, .max = 100000});
  d.Check("read_out", [&c] { return WrongTimes(c, c.eye_offset); });
}

RgbdCameraConfig::RgbdCameraConfig() {
  kind = stack::CameraKind::kColour;
  rate = {30, 1};
  fov = 1.0471975511965976;  // 60 deg
}

void Describe(base::Description& d, DepthCameraConfig& c) {
  d.Field("width", c.width, {.unit = "1", .meaning = "pixels a row", .min = 16, .max = 4096});
  d.Field("height", c.height, {.unit = "1", .meaning = "rows", .min = 16, .max = 4096});
  d.Field("fov", c.fov, {.unit = "rad", .meaning = "field of view across the middle row", .min = 0.05, .max = 2.8});
  d.Field("offset", c.offset, {.unit = "m", .meaning = "along the colour camera's x axis", .min = -1, .max = 1});
  d.Field("registered", c.registered, {.meaning = "carried over to the colour camera's pixels"});
  d.Field("read_out", c.read_out,
          {.unit = "s", .meaning = "from the middle of the exposure to the stack", .min = 0, .max = 10});
  d.Field("light", c.light, {.meaning = "how depth is measured"});
}

void Describe(base::Description& d, RgbdCameraConfig& c) {
  Describe(d, static_cast<NamedCameraConfig&>(c));
  d.Field("depth", c.depth, {.meaning = "the depth camera beside it"});
  d.Check("depth", [&c] {
    return c.depth.registered && !stack::IsPinhole(IntrinsicsOf(c))
               ? std::string("can be registered to a colour camera without lens distortion only; say registered: false")
               : std::string();
  });
}

stack::CameraIntrinsics DepthIntrinsicsOf(const DepthCameraConfig& config) {
  const double focal = 0.5 * config.width / std::tan(0.5 * config.fov);
  return {.width = config.width,
          .height = config.height,
          .fx = focal,
          .fy = focal,
          .cx = 0.5 * (config.width - 1),
          .cy = 0.5 * (config.height - 1),
          .distortion = {}};
}

stack::CameraIntrinsics IntrinsicsOf(const CameraConfig& config) {
  stack::CameraIntrinsics k{.width = config.width,
                            .height = config.height,
                            .fx = 1.0,
                            .fy = 1.0,
                            .cx = 0.0,
                            .cy = 0.0,
                            .distortion = {},
                            .model = config.lens.model};
  std::copy_n(config.lens.coefficients.begin(), std::min(config.lens.coefficients.size(), k.distortion.size()),
              k.distortion.begin());
  const base::Vec3 edge(std::sin(0.5 * config.fov), 0.0, std::cos(0.5 * config.fov));
  k.fx = k.fy = 0.5 * config.width / stack::Project(k, edge).x();
  k.cx = 0.5 * (config.width - 1);
  k.cy = 0.5 * (config.height - 1);
  return k;
}

base::Transform MountPose(const CameraConfig& config) {
  return {base::FromYawPitchRoll(config.yaw, config.pitch, config.roll) * base::ForwardCameraRotation(),
          config.position};
}

base::Transform EyePose(const StereoCameraConfig& config, int eye) {
  const double side = eye == 0 ? -0.5 : 0.5;
  return MountPose(config) * base::Transform{base::Quat::Identity(), {side * config.baseline, 0.0, 0.0}};
}

}  // namespace alula::sim
