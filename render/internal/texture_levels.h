#pragma once

#include <cstdint>
#include <vector>

#include "geometry/material.h"

namespace alula::render::internal {

/// One level of a mip chain: rows from v = 0 upwards, `channels` bytes a texel, without gaps.
struct TextureLevel {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;
};

/// What a pass samples: nothing, luma, luma in the near infrared, or RGB.
enum class TextureKind { kNone, kLuma, kInfrared, kColour };
constexpr TextureKind TextureKindOf(bool infrared, int channels) {
  if (channels == 3) return TextureKind::kColour;
  return infrared ? TextureKind::kInfrared : TextureKind::kLuma;
}
constexpr int ChannelsOf(TextureKind kind) { return kind == TextureKind::kColour ? 3 : 1; }

/// The albedo of a material (colour times texture, times its factor in the infrared; one texel where it has no
/// texture) and its mip chain down to 1×1 by averages of 2×2 texels. Luma is 0.299 R + 0.587 G + 0.114 B (ITU-R
/// BT.601). Throws base::FaultError for a texture whose sides are no powers of two or whose bytes do not fit its sides.
std::vector<TextureLevel> TextureLevels(const geometry::Material& material, TextureKind kind);

/// The mip chain of a texture with holes: averages of 2×2 texels, each level scaled so that the share of its texels
/// which are there (at or above kAlphaThere) stays that of the first, and at least one is: far leaves do not vanish
/// (Castaño 2010). Throws base::FaultError where the bytes do not fit the sides.
std::vector<TextureLevel> AlphaLevels(const geometry::Material& material);
inline constexpr float kAlphaThere = 127.5F;

}  // namespace alula::render::internal
