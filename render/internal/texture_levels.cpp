#include "render/internal/texture_levels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>

#include "base/error.h"

namespace alula::render::internal {
namespace {

std::uint8_t ToByte(float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 255.0F) + 0.5F); }

void CheckTexture(const geometry::Material& material) {
  const geometry::Texture& t = *material.texture;
  const bool powers = t.width > 0 && t.height > 0 && std::has_single_bit(static_cast<unsigned>(t.width)) &&
                      std::has_single_bit(static_cast<unsigned>(t.height));
  if (!powers || t.rgb.size() != 3UL * static_cast<std::size_t>(t.width) * static_cast<std::size_t>(t.height)) {
    throw base::FaultError("render", "texture of material \"" + material.name + "\" is not a power of two a side");
  }
}

TextureLevel BaseLevel(const geometry::Material& material, TextureKind kind) {
  constexpr std::uint8_t kWhite[3] = {255, 255, 255};
  TextureLevel level{1, 1, {}};
  const std::uint8_t* texels = kWhite;
  if (material.texture) {
    CheckTexture(material);
    level.width = material.texture->width;
    level.height = material.texture->height;
    texels = material.texture->rgb.data();
  }
  const float factor = kind == TextureKind::kInfrared ? material.infrared : 1.0F;
  const Eigen::Vector3f colour = factor * material.colour;
  const std::size_t count = static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
  level.bytes.reserve(count * static_cast<std::size_t>(ChannelsOf(kind)));
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3f rgb =
        colour.cwiseProduct(Eigen::Vector3f(texels[3 * i], texels[3 * i + 1], texels[3 * i + 2]));
    if (kind != TextureKind::kColour) {
      level.bytes.push_back(ToByte(0.299F * rgb[0] + 0.587F * rgb[1] + 0.114F * rgb[2]));
    } else {
      for (int c = 0; c < 3; ++c) level.bytes.push_back(ToByte(rgb[c]));
    }
  }
  return level;
}

TextureLevel Halve(const TextureLevel& above, int channels) {
  TextureLevel level{std::max(1, above.width / 2), std::max(1, above.height / 2), {}};
  const int right = above.width > 1 ? 1 : 0;
  const int up = above.height > 1 ? 1 : 0;
  const auto at = [&](int x, int y, int c) -> int {
    return above
        .bytes[(static_cast<std::size_t>(y) * static_cast<std::size_t>(above.width) + static_cast<std::size_t>(x)) *
                   static_cast<std::size_t>(channels) +
               static_cast<std::size_t>(c)];
  };
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      const int x0 = x * (1 + right);
      const int y0 = y * (1 + up);
      for (int c = 0; c < channels; ++c) {
        const int sum = at(x0, y0, c) + at(x0 + right, y0, c) + at(x0, y0 + up, c) + at(x0 + right, y0 + up, c);
        level.bytes.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
      }
    }
  }
  return level;
}

bool IsThere(std::uint8_t alpha) { return static_cast<float>(alpha) >= kAlphaThere; }

/// Scales the level so that `share` of its texels are there.
TextureLevel WithCoverage(TextureLevel level, double share) {
  std::vector<std::uint8_t> sorted = level.bytes;
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  const auto count = static_cast<double>(sorted.size());
  const auto wanted = static_cast<std::size_t>(std::clamp(std::round(share * count), 1.0, count));
  const auto threshold = static_cast<float>(std::max<std::uint8_t>(sorted[wanted - 1], 1));
  // One more than half, so that the texel at the threshold itself is there after rounding.
  for (std::uint8_t& alpha : level.bytes) alpha = ToByte(static_cast<float>(alpha) * (128.0F / threshold));
  return level;
}

}  // namespace

std::vector<TextureLevel> AlphaLevels(const geometry::Material& material) {
  CheckTexture(material);
  const geometry::Texture& texture = *material.texture;
  if (3 * texture.alpha.size() != texture.rgb.size()) {
    throw base::FaultError("render", "alpha of material \"" + material.name + "\" does not fit its texture");
  }
  TextureLevel plain{texture.width, texture.height, texture.alpha};
  const auto there = static_cast<double>(std::count_if(plain.bytes.begin(), plain.bytes.end(), IsThere));
  const double share = there / static_cast<double>(plain.bytes.size());
  std::vector<TextureLevel> levels{plain};
  while (plain.width > 1 || plain.height > 1) {
    plain = Halve(plain, 1);
    levels.push_back(share > 0.0 ? WithCoverage(plain, share) : plain);
  }
  return levels;
}

std::vector<TextureLevel> TextureLevels(const geometry::Material& material, TextureKind kind) {
  std::vector<TextureLevel> levels{BaseLevel(material, kind)};
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(Halve(levels.back(), ChannelsOf(kind)));
  return levels;
}

}  // namespace alula::render::internal
