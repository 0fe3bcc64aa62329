#include "render/internal/dirt.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/random.h"
#include "render/internal/smooth_light.h"

namespace alula::render::internal {
namespace {

float SmoothStep(float x) {
  const float t = std::clamp(x, 0.0F, 1.0F);
  return t * t * (3.0F - 2.0F * t);
}

/// The value that a `share` of all lie above.
float UpperQuantile(std::vector<float> values, double share) {
  const auto rank = static_cast<std::size_t>((1.0 - share) * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

/// Adds (1 − d²/R²)² about a point.
void AddDisc(std::vector<float>& field, int width, int height, const std::array<double, 2>& middle, double radius,
             double weight) {
  const int top = std::max(0, static_cast<int>(middle[1] - radius));
  const int bottom = std::min(height - 1, static_cast<int>(middle[1] + radius));
  const int left = std::max(0, static_cast<int>(middle[0] - radius));
  const int right = std::min(width - 1, static_cast<int>(middle[0] + radius));
  for (int v = top; v <= bottom; ++v) {
    for (int u = left; u <= right; ++u) {
      const double x = (u - middle[0]) / radius, y = (v - middle[1]) / radius;
      const double rest = 1.0 - x * x - y * y;
      if (rest <= 0.0) continue;
      field[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u)] +=
          static_cast<float>(weight * rest * rest);
    }
  }
}

/// The field as it is interpolated between SmoothLight's nodes, so that what is taken from a pixel is what comes back.
std::vector<float> Coarsened(const std::vector<float>& field, int width, int height) {
  constexpr int kCell = SmoothLight::kCell;
  const int last_u = (width - 1) / kCell * kCell, last_v = (height - 1) / kCell * kCell;  // level beyond these
  const auto at = [&](int u, int v) {
    return field[static_cast<std::size_t>(std::min(v, last_v)) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(std::min(u, last_u))];
  };
  std::vector<float> coarse;
  coarse.reserve(field.size());
  for (int v = 0; v < height; ++v) {
    const int top = v - v % kCell;
    const float down = static_cast<float>(v % kCell) / kCell;
    for (int u = 0; u < width; ++u) {
      const int left = u - u % kCell;
      const float right = static_cast<float>(u % kCell) / kCell;
      const float upper = at(left, top) + right * (at(left + kCell, top) - at(left, top));
      const float lower = at(left, top + kCell) + right * (at(left + kCell, top + kCell) - at(left, top + kCell));
      coarse.push_back(upper + down * (lower - upper));
    }
  }
  return coarse;
}

/// Dirt on the front lens is far out of focus: discs from a fifteenth to a third of the picture's width.
std::vector<float> SmudgeField(int width, int height, base::RandomStream& random) {
  std::vector<float> field(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0F);
  constexpr int kDiscs = 90;
  for (int i = 0; i < kDiscs; ++i) {
    const double radius = width * (0.067 + 0.27 * std::pow(random.Uniform(), 2.0));
    const std::array<double, 2> middle = {random.Uniform(-0.1, 1.1) * width, random.Uniform(-0.1, 1.1) * height};
    AddDisc(field, width, height, middle, radius, random.Uniform(0.3, 1.0));
  }
  return field;
}

/// Minus the distance from the mud's middle, px, stretched by a wavy rim.
std::vector<float> MudField(int width, int height, base::RandomStream& random) {
  const double u0 = random.Uniform(0.0, width), v0 = random.Uniform(0.0, height);
  std::array<double, 5> size{}, phase{};
  for (std::size_t k = 0; k < size.size(); ++k) {
    size[k] = random.Uniform(0.0, 0.18) / static_cast<double>(k + 1);
    phase[k] = random.Uniform(0.0, 2.0 * M_PI);
  }
  std::vector<float> field;
  field.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const double angle = std::atan2(v - v0, u - u0);
      double rim = 1.0;
      for (std::size_t k = 0; k < size.size(); ++k) {
        rim += size[k] * std::cos(static_cast<double>(k + 1) * angle + phase[k]);
      }
      field.push_back(static_cast<float>(-std::hypot(u - u0, v - v0) / rim));
    }
  }
  return field;
}

}  // namespace

DirtMap MakeDirt(const Dirt& dirt, int width, int height, std::uint64_t key) {
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  DirtMap map{std::vector<float>(count, 1.0F), std::vector<float>(count, 0.0F)};
  if (dirt.smudged > 0.0) {
    base::RandomStream random(key, "smudges");
    const std::vector<float> field = SmudgeField(width, height, random);
    const float limit = UpperQuantile(field, dirt.smudged);
    constexpr float kRim = 1.0F;  // of the field: a fair smudge reaches two or three
    const auto loss = static_cast<float>(dirt.smudge_loss);
    for (std::size_t i = 0; i < count; ++i) map.scattered[i] = loss * SmoothStep((field[i] - limit) / kRim);
    map.scattered = Coarsened(map.scattered, width, height);
    for (std::size_t i = 0; i < count; ++i) map.through[i] = 1.0F - map.scattered[i];
  }
  if (dirt.obscured > 0.0) {
    base::RandomStream random(key, "mud");
    const std::vector<float> field = MudField(width, height, random);
    const float limit = UpperQuantile(field, dirt.obscured);
    const float rim = 0.02F * static_cast<float>(width);  // px, blurred; half of it on either side
    for (std::size_t i = 0; i < count; ++i) {
      const float clear = dirt.obscured >= 1.0 ? 0.0F : 1.0F - SmoothStep((field[i] - limit) / rim + 0.5F);
      map.through[i] *= clear;
      map.scattered[i] *= clear;
    }
  }
  return map;
}

}  // namespace alula::render::internal
