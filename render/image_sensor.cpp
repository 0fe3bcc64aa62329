#include "render/image_sensor.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/hash.h"
#include "base/random.h"
#include "render/internal/dirt.h"
#include "render/internal/sensor_kernel.h"
#include "render/internal/smooth_light.h"

namespace alula::render {
namespace {

constexpr double kFixed = 32768.0;    // steps of 1 in transmission and response
constexpr double kDarkSteps = 256.0;  // of a grey level

std::int16_t ToFixed(double value) {
  return static_cast<std::int16_t>(std::clamp(std::round(value), -32767.0, 32767.0));
}

/// cos⁴ θ = (1 + tan² θ)⁻², with tan θ in proportion to the distance from the principal point.
std::vector<double> Vignette(double lost_in_corner, const stack::CameraIntrinsics& camera) {
  const double u0 = std::max(camera.cx, camera.width - 1 - camera.cx);
  const double v0 = std::max(camera.cy, camera.height - 1 - camera.cy);
  const double tangent2 = (1.0 / std::sqrt(1.0 - lost_in_corner) - 1.0) / (u0 * u0 + v0 * v0);  // a pixel²
  std::vector<double> share;
  share.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double r2 = (u - camera.cx) * (u - camera.cx) + (v - camera.cy) * (v - camera.cy);
      share.push_back(1.0 / ((1.0 + tangent2 * r2) * (1.0 + tangent2 * r2)));
    }
  }
  return share;
}

/// What each value, in steps of 1/kToneSteps, is shown as.
std::vector<std::uint8_t> ToneTable(double gamma, int bits) {
  const double codes = std::exp2(bits) - 1.0;
  std::vector<std::uint8_t> table;
  for (int i = 0; i <= 255 * internal::kToneSteps; ++i) {
    const double value = static_cast<double>(i) / internal::kToneSteps / 255.0;
    const double code = std::floor(codes * std::pow(value, 1.0 / gamma) + 0.5);
    table.push_back(static_cast<std::uint8_t>(255.0 * code / codes + 0.5));
  }
  return table;
}

std::vector<std::int16_t> Deviates(double sigma, std::size_t count, std::uint64_t key, std::string_view name) {
  base::RandomStream random(key, name);
  std::vector<std::int16_t> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) values.push_back(ToFixed(sigma * random.Gaussian()));
  return values;
}

void CheckEffects(const SensorEffects& effects, int channels) {
  if (effects.bits < 1 || effects.bits > 8) {
    throw base::InputError("sensor effects: bits is " + std::to_string(effects.bits) + "; it must be in [1, 8]");
  }
  if (!(effects.gamma > 0.0)) throw base::InputError("sensor effects: gamma must be above 0");
  if (!(effects.vignetting >= 0.0 && effects.vignetting < 1.0)) {
    throw base::InputError("sensor effects: vignetting is the share lost in the corner; it must be in [0, 1)");
  }
  if (channels != 1 && channels != 3) throw base::FaultError("sensor_channels", "a picture has 1 or 3 channels");
}

}  // namespace

ImageSensor::ImageSensor(const SensorEffects& effects, const stack::CameraIntrinsics& camera, int channels,
                         std::uint64_t camera_key)
    : effects_(effects), width_(camera.width), height_(camera.height), channels_(channels) {
  CheckEffects(effects, channels);
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  const std::size_t bytes = pixels * static_cast<std::size_t>(channels);
  const bool dirty = effects.dirt.smudged > 0.0 || effects.dirt.obscured > 0.0;
  std::vector<float> scattered;
  if (effects.vignetting > 0.0 || dirty) {
    std::vector<double> share = Vignette(effects.vignetting, camera);
    if (dirty) {
      internal::DirtMap dirt = internal::MakeDirt(effects.dirt, width_, height_, camera_key);
      for (std::size_t i = 0; i < pixels; ++i) share[i] *= static_cast<double>(dirt.through[i]);
      if (effects.dirt.smudged > 0.0) scattered = std::move(dirt.scattered);
    }
    transmission_.reserve(bytes);
    for (const double s : share) {
      transmission_.insert(transmission_.end(), static_cast<std::size_t>(channels),
                           static_cast<std::uint16_t>(kFixed * s + 0.5));
    }
  }
  if (effects.fixed_pattern.response > 0.0 || effects.fixed_pattern.dark > 0.0) {
    response_ = Deviates(kFixed * effects.fixed_pattern.response, bytes, camera_key, "response");
    dark_ = Deviates(kDarkSteps * effects.fixed_pattern.dark, bytes, camera_key, "dark");
  }
  if (effects.gamma != 1.0 || effects.bits != 8) tone_ = ToneTable(effects.gamma, effects.bits);
  if (!scattered.empty() || effects.glare.veil > 0.0) {
    added_ = std::make_unique<internal::SmoothLight>(effects.glare, scattered, camera, channels);
  }
}

ImageSensor::~ImageSensor() = default;
ImageSensor::ImageSensor(ImageSensor&&) noexcept = default;
ImageSensor& ImageSensor::operator=(ImageSensor&&) noexcept = default;

void ImageSensor::Apply(Picture& picture, std::uint64_t frame_key, const FrameSettings& frame) const {
  if (picture.width != width_ || picture.height != height_ || picture.channels != channels_) {
    throw base::FaultError("sensor_picture", "a picture of another size than the sensor's");
  }
  const std::vector<float> nodes = added_ ? added_->Nodes(picture, frame) : std::vector<float>();
  const double read = frame.gain * effects_.noise.read_sigma;
  const bool noisy = read > 0.0 || frame.gain * effects_.noise.shot > 0.0;
  if (!noisy && transmission_.empty() && response_.empty() && tone_.empty() && nodes.empty()) return;

  base::RollingHash spread;  // so that neighbouring keys share nothing
  spread.Add(frame_key);
  constexpr double kRounding = 1.0 / 12.0;  // variance that rounding to grey levels adds
  internal::SensorJob job{.pixels = picture.bytes.data(),
                          .count = picture.bytes.size(),
                          .first = 0,
                          .key0 = static_cast<std::uint32_t>(spread.value()),
                          .key1 = static_cast<std::uint32_t>(spread.value() >> 32),
                          .read_variance = static_cast<float>(read * read - (tone_.empty() ? kRounding : 0.0)),
                          .shot = static_cast<float>(frame.gain * effects_.noise.shot),
                          .transmission = transmission_.empty() ? nullptr : transmission_.data(),
                          .added = nullptr,
                          .response = response_.empty() ? nullptr : response_.data(),
                          .dark = dark_.empty() ? nullptr : dark_.data(),
                          .dark_step = static_cast<float>(frame.gain / kDarkSteps),
                          .tone = tone_.empty() ? nullptr : tone_.data()};
  static const internal::SensorKernel kernel = internal::ChooseSensorKernel();
  if (nodes.empty()) {
    kernel(job);
    return;
  }
  const std::size_t row_bytes = static_cast<std::size_t>(width_) * static_cast<std::size_t>(channels_);
  std::vector<float> added;
  job.count = row_bytes;
  for (int v = 0; v < height_; ++v) {
    added_->Row(nodes, v, added);
    job.added = added.data();
    kernel(job);
    job.pixels += row_bytes;
    job.first += static_cast<std::uint32_t>(row_bytes);
    if (job.transmission != nullptr) job.transmission += row_bytes;
    if (job.response != nullptr) {
      job.response += row_bytes;
      job.dark += row_bytes;
    }
  }
}

}  // namespace alula::render
