#include "sim/sensors/stereo_camera.h"

#include <cmath>
#include <memory>

#include "base/hash.h"

namespace alula::sim {

void Describe(base::Description& d, StereoCameraConfig& c) {
  d.Field("rate", c.rate, {.unit = "Hz", .meaning = "pairs a second"});
  d.Field("width", c.width, {.unit = "1", .meaning = "pixels a row", .min = 16, .max = 4096});
  d.Field("height", c.height, {.unit = "1", .meaning = "rows", .min = 16, .max = 4096});
  d.Field("fov", c.fov, {.unit = "rad", .meaning = "horizontal field of view", .min = 0.1, .max = 2.8});
  d.Field("baseline", c.baseline, {.unit = "m", .meaning = "distance between the eyes", .min = 0.005, .max = 2});
  d.Field("position", c.position, {.unit = "m", .meaning = "of the pair's middle in the body frame"});
  d.Field("pitch", c.pitch,
          {.unit = "rad", .meaning = "optical axes below the body's horizon", .min = -1.6, .max = 1.6});
  d.Field("exposure", c.exposure, {.unit = "s", .meaning = "length of the exposure; stamps are of its middle"});
  d.Field("read_out", c.read_out, {.unit = "s", .meaning = "from the middle of the exposure to the stack"});
  d.Field("noise", c.noise, {.meaning = "of the pixels"});
}

stack::CameraIntrinsics IntrinsicsOf(const StereoCameraConfig& config) {
  const double focal = 0.5 * config.width / std::tan(0.5 * config.fov);
  return {.width = config.width,
          .height = config.height,
          .fx = focal,
          .fy = focal,
          .cx = 0.5 * (config.width - 1),
          .cy = 0.5 * (config.height - 1),
          .distortion = {}};
}

base::Transform EyePose(const StereoCameraConfig& config, int eye) {
  const base::Quat q_BC = base::FromYawPitchRoll(0.0, config.pitch, 0.0) * base::ForwardCameraRotation();
  const double side = eye == 0 ? 0.5 : -0.5;  // the body's y axis points left
  return {q_BC, config.position + base::Vec3(0.0, side * config.baseline, 0.0)};
}

stack::Image TakeImage(const StereoCameraConfig& config, int eye, const base::Transform& X_WB, base::Time captured,
                       std::uint32_t seq, std::uint64_t seed, std::string_view name, render::CameraRenderer& renderer) {
  render::Picture picture;
  renderer.Grey({.X_WC = X_WB * EyePose(config, eye), .intrinsics = IntrinsicsOf(config), .draw_movers = false},
                picture);
  base::RollingHash key;
  key.Add(seed);
  key.Add(name);
  key.Add(std::uint64_t{seq});
  render::ApplyPixelNoise(picture, key.value(), config.noise);

  stack::Image image;
  image.width = picture.width;
  image.height = picture.height;
  image.stride = picture.width;
  image.exposure_start = captured + base::Nanoseconds(-config.exposure.ns / 2);
  image.exposure = config.exposure;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(picture.bytes));
  return image;
}

}  // namespace alula::sim
