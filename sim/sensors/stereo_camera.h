#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/describe.h"
#include "base/frames.h"
#include "base/time.h"
#include "render/camera_renderer.h"
#include "render/sensor_effects.h"
#include "stack/interface/calibration.h"
#include "stack/interface/measurement.h"

namespace alula::sim {

/// Two equal global-shutter pinhole cameras side by side, in one plane, looking forward.
struct StereoCameraConfig {
  base::Rate rate{20, 1};
  int width = 640;                                  // px
  int height = 480;                                 // px
  double fov = 1.3962634015954636;                  // horizontal, rad (80 deg)
  double baseline = 0.11;                           // m
  base::Vec3 position{0.10, 0.0, -0.02};            // of the pair's middle in the body frame, m
  double pitch = 0.0;                               // optical axes below the horizon of the body, rad
  base::Duration exposure = base::Milliseconds(4);  // stamps are of its middle; pictures are sharp
  base::Duration read_out = base::Milliseconds(10);
  render::PixelNoise noise;
};
void Describe(base::Description& d, StereoCameraConfig& c);

/// Of either eye: square pixels, centre of the image.
stack::CameraIntrinsics IntrinsicsOf(const StereoCameraConfig& config);
/// X_BC of eye 0 (left) or 1 (right).
base::Transform EyePose(const StereoCameraConfig& config, int eye);

/// Draws and spoils one eye's picture at an exact instant. Pure: the same arguments give the same bytes, whatever
/// thread it runs on, because the noise is keyed by (seed, eye's name, seq).
stack::Image TakeImage(const StereoCameraConfig& config, int eye, const base::Transform& X_WB, base::Time captured,
                       std::uint32_t seq, std::uint64_t seed, std::string_view name, render::CameraRenderer& renderer);

}  // namespace alula::sim
