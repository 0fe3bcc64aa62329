#pragma once

#include <cstdint>

#include "base/describe.h"
#include "render/camera_renderer.h"

namespace alula::render {

/// Noise of an 8-bit image sensor, in grey levels: the variance of a pixel of mean value v is read_sigma² + shot·v
/// (EMVA 1288, section 2.3; a linear sensor without dark-signal non-uniformity).
struct PixelNoise {
  double read_sigma = 0.8;  // standard deviation in the dark, grey levels; a global-shutter CMOS at unit gain
  double shot = 0.012;      // variance per grey level: 255 levels on a full well of about 20,000 electrons
};
void Describe(base::Description& d, PixelNoise& c);

/// Adds shot and read noise to every byte of the picture and rounds to [0, 255]. The noise is a pure function of
/// (key, place, value): give each image its own key (for instance hash of run seed, sensor name and sequence number).
/// Deviates are sums of four bytes of a 32-bit mix: normal to within ±3.4 σ. Equal on every machine.
void ApplyPixelNoise(Picture& picture, std::uint64_t key, const PixelNoise& noise);

}  // namespace alula::render
