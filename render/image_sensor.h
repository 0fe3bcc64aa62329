#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "base/frames.h"
#include "render/camera_renderer.h"
#include "render/sensor_effects.h"

namespace alula::render {

namespace internal {
class SmoothLight;
}

/// A light that may blind a camera.
struct GlareLight {
  base::Vec3 to_light_C;  // unit vector in the camera frame
  double power = 1.0;     // the sun is 1; times the share of it that nothing hides
};

/// What changes from frame to frame.
struct FrameSettings {
  double gain = 1.0;        // of the amplifier: of noise and dark offset, the picture being drawn with it
  double brightness = 1.0;  // exposure and gain over the nominal ones, as in View: of glare
  std::span<const GlareLight> lights{};
};

/// One camera's SensorEffects, ready to be applied: what belongs to the pixels for good is drawn once from
/// `camera_key`. Pure and const: any thread may apply it. Equal bytes on every machine of one numeric class.
///
///   light = min((p T + g) (1 + r), 255),   y = light + √(gain² read_sigma² + gain shot light) n + gain d,
///
/// with p the picture's value, T the share that vignetting and dirt let through, g what dirt and glare add, r and d the
/// pixel's own response and offset, n a standard normal deviate; then gamma and bits.
/// Highlights that were cut off at 255 when the picture was drawn dim from there.
class ImageSensor {
 public:
  /// `camera`: intrinsics of the pictures, distortion included. `channels`: 1 or 3. Throws base::InputError for
  /// impossible bits, gamma or vignetting.
  ImageSensor(const SensorEffects& effects, const stack::CameraIntrinsics& camera, int channels,
              std::uint64_t camera_key);
  ~ImageSensor();
  ImageSensor(ImageSensor&&) noexcept;
  ImageSensor& operator=(ImageSensor&&) noexcept;

  /// `frame_key`: of the noise, as in ApplyPixelNoise, which this equals where nothing but noise is on and gain is 1.
  /// Throws base::FaultError for a picture of another size.
  void Apply(Picture& picture, std::uint64_t frame_key, const FrameSettings& frame = {}) const;

 private:
  SensorEffects effects_;
  int width_ = 0, height_ = 0, channels_ = 1;
  std::vector<std::uint16_t> transmission_;       // by byte of the picture, 1/32768; empty: 1
  std::vector<std::int16_t> response_;            // likewise, 1/32768; empty: 0
  std::vector<std::int16_t> dark_;                // likewise, 1/256 level
  std::vector<std::uint8_t> tone_;                // what a value in 1/16 level is shown as; empty: itself
  std::unique_ptr<internal::SmoothLight> added_;  // dirt's haze and glare; null: none
};

}  // namespace alula::render
