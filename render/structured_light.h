#pragma once

#include <cstdint>
#include <vector>

#include "base/describe.h"
#include "render/camera_renderer.h"

namespace alula::render {

/// A depth camera that finds a projected pattern again by its disparity d = f b / z (Khoshelham and Elberink 2012). The
/// projector sits `baseline` to the left of the infrared camera.
struct StructuredLight {
  double baseline = 0.075;        // m
  double disparity_noise = 0.1;   // 1σ, px
  double disparity_step = 0.125;  // what disparity is rounded to, px
  double nearest = 0.3;           // m; what is nearer or farther is lost
  double farthest = 3.0;
  double grazing = 1.3962634015954636;  // angle between ray and normal above which the pattern is lost, rad (80 deg)
  double holes = 0.002;                 // share of spots that are lost anywhere
  double blinding = 0.98;               // share of full scale of the grey picture at which light drowns the pattern
};
void Describe(base::Description& d, StructuredLight& c);

/// Depth as that camera measures it, planar, mm; 0 where it could not: z' = f b / round(f b / z + n) with noise n of
/// disparity_noise that neighbours share (a matching window's width), σ_z = z²/(f b) · √(disparity_noise² + step²/12).
/// Lost are: what the projector cannot see past a nearer thing on its left (f b (1/z₁ − 1/z₂) px beside an edge), edges
/// and grazing surfaces, random spots, what is out of range, what ambient light drowns (`ambient`: the grey picture of
/// the same view, or null), and what `glass` says (one byte a pixel, or null).
/// `key` keys the noise as in ApplyPixelNoise.
std::vector<std::uint16_t> MeasureDepth(const DepthPicture& depth, double focal, const Picture* ambient,
                                        const std::vector<std::uint8_t>* glass, const StructuredLight& sensor,
                                        std::uint64_t key);

/// Depth as the pixels of another camera see it: each pixel's patch carried over, the nearest wins, planar depth along
/// the other camera's axis, mm. Both cameras are pinholes. X_CD: pose of the depth camera in the other one.
std::vector<std::uint16_t> RegisterDepth(const std::vector<std::uint16_t>& millimetres,
                                         const stack::CameraIntrinsics& depth, const stack::CameraIntrinsics& other,
                                         const base::Transform& X_CD);

}  // namespace alula::render
