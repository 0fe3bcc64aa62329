#include "render/internal/smooth_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "stack/interface/camera_model.h"

namespace alula::render::internal {
namespace {

using base::Vec2;
using base::Vec3;

constexpr double kVeilAngle = 10.0 * M_PI / 180.0;  // rad off the light, where Glare::veil is stated
constexpr double kCore = 1.5 * M_PI / 180.0;        // rad: inside it the veil is level
constexpr double kHoodEdge = 5.0 * M_PI / 180.0;    // rad over which the hood shades the light

/// A light's image after two reflections: at `place` times the light's own place, counted from the middle of the
/// picture; a soft disc. Four of the many that a lens of five elements or so makes.
struct Ghost {
  double place;
  double radius;  // share of the picture's width
  double weight;
};
constexpr std::array<Ghost, 4> kGhosts = {
    {{-0.35, 0.035, 1.0}, {0.45, 0.025, 0.8}, {-0.62, 0.07, 0.5}, {-1.1, 0.11, 0.3}}};

/// The ray of a node; one outside the picture may have none: then that of the nearest pixel.
Vec3 RayAt(const stack::CameraIntrinsics& camera, const Vec2& pixel) {
  const Vec3 ray = stack::Ray(camera, pixel);
  if (ray.allFinite() && (stack::Project(camera, ray) - pixel).norm() < 0.5) return ray;
  return stack::Ray(camera, {std::min(pixel.x(), camera.width - 1.0), std::min(pixel.y(), camera.height - 1.0)});
}

}  // namespace

SmoothLight::SmoothLight(const Glare& glare, std::span<const float> scattered, const stack::CameraIntrinsics& camera,
                         int channels)
    : glare_(glare),
      camera_(camera),
      channels_(channels),
      columns_((camera.width - 1) / kCell + 2),
      rows_((camera.height - 1) / kCell + 2) {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      if (glare.veil > 0.0) rays_.push_back(RayAt(camera, {kCell * column, kCell * row}));
      if (scattered.empty()) continue;
      const auto u = static_cast<std::size_t>(std::min(kCell * column, camera.width - 1));
      const auto v = static_cast<std::size_t>(std::min(kCell * row, camera.height - 1));
      haze_.push_back(scattered[v * static_cast<std::size_t>(camera.width) + u]);
    }
  }
}

std::vector<float> SmoothLight::Nodes(const Picture& picture, const FrameSettings& frame) const {
  const bool glares = !rays_.empty() && !frame.lights.empty();
  if (haze_.empty() && !glares) return {};
  std::vector<float> nodes(static_cast<std::size_t>(columns_ * rows_ * channels_), 0.0F);
  if (!haze_.empty()) AddHaze(picture, nodes);
  if (!glares) return nodes;
  for (const GlareLight& light : frame.lights) AddGlare(light, frame.brightness, nodes);
  return nodes;
}

/// What is scattered anywhere arrives everywhere: the picture's mean, taken from every eighth row.
void SmoothLight::AddHaze(const Picture& picture, std::vector<float>& nodes) const {
  std::array<std::uint64_t, 3> sums{};
  std::uint64_t count = 0;
  const auto width = static_cast<std::size_t>(picture.width), channels = static_cast<std::size_t>(channels_);
  for (int v = 0; v < picture.height; v += kCell) {
    const std::uint8_t* row = picture.bytes.data() + static_cast<std::size_t>(v) * width * channels;
    for (std::size_t i = 0; i < width; ++i) {
      for (std::size_t c = 0; c < channels; ++c) sums[c] += row[i * channels + c];
    }
    count += width;
  }
  for (std::size_t i = 0; i < haze_.size(); ++i) {
    for (std::size_t c = 0; c < channels; ++c) {
      nodes[i * channels + c] +=
          haze_[i] * static_cast<float>(static_cast<double>(sums[c]) / static_cast<double>(count));
    }
  }
}

void SmoothLight::AddGlare(const GlareLight& light, double brightness, std::vector<float>& nodes) const {
  const double off_axis = std::acos(std::clamp(light.to_light_C.z(), -1.0, 1.0));
  const double unshaded = std::clamp((glare_.reach - off_axis) / kHoodEdge, 0.0, 1.0);
  const double veil = glare_.veil * brightness * light.power * unshaded;
  if (!(veil > 0.0)) return;
  const bool has_image = off_axis < std::min(stack::LargestAngle(camera_), 1.4);
  const Vec2 middle(camera_.cx, camera_.cy);
  const Vec2 image = has_image ? Vec2(stack::Project(camera_, light.to_light_C)) : middle;
  std::size_t node = 0;
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column, ++node) {
      // The chord between two unit vectors stands for the angle: 1 % apart at 28°.
      const double squared = (rays_[node] - light.to_light_C).squaredNorm();
      double levels = veil * kVeilAngle * kVeilAngle / std::max(squared, kCore * kCore);
      for (const Ghost& ghost : kGhosts) {
        if (!has_image) break;
        const Vec2 from = Vec2(kCell * column, kCell * row) - middle - ghost.place * (image - middle);
        const double radius = ghost.radius * camera_.width;
        // Level inside, a soft rim of a third of the radius.
        const double rim = std::clamp(3.0 * (1.0 - from.norm() / radius), 0.0, 1.0);
        levels += veil * glare_.ghosts * ghost.weight * rim;
      }
      for (int c = 0; c < channels_; ++c) {
        nodes[node * static_cast<std::size_t>(channels_) + static_cast<std::size_t>(c)] += static_cast<float>(levels);
      }
    }
  }
}

void SmoothLight::Row(std::span<const float> nodes, int v, std::vector<float>& out) const {
  const auto channels = static_cast<std::size_t>(channels_);
  const std::size_t per_row = static_cast<std::size_t>(columns_) * channels;
  const float* upper = nodes.data() + static_cast<std::size_t>(v / kCell) * per_row;
  const float* lower = upper + per_row;
  const float down = static_cast<float>(v % kCell) / kCell;
  out.resize(static_cast<std::size_t>(columns_ - 1) * kCell * channels);
  float* to = out.data();
  const std::size_t cells = static_cast<std::size_t>(columns_ - 1) * channels;
  if (channels_ == 1) {
    for (std::size_t i = 0; i < cells; ++i, to += kCell) {
      const float left = upper[i] + down * (lower[i] - upper[i]);
      const float right = upper[i + 1] + down * (lower[i + 1] - upper[i + 1]);
      const float step = (right - left) / kCell;
      for (int x = 0; x < kCell; ++x) to[x] = left + step * static_cast<float>(x);
    }
    return;
  }
  for (std::size_t i = 0; i < cells; ++i) {
    const float left = upper[i] + down * (lower[i] - upper[i]);
    const std::size_t next = i + channels;
    const float right = upper[next] + down * (lower[next] - upper[next]);
    const float step = (right - left) / kCell;
    float* first = to + (i / channels) * kCell * channels + i % channels;
    for (std::size_t x = 0; x < kCell; ++x) first[x * channels] = left + step * static_cast<float>(x);
  }
}

}  // namespace alula::render::internal
