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
constexpr int ChannelsOf(TextureKind kind) { return kind == TextureKind::kColour ? 3 : 1; }

/// The albedo of a material (colour times texture, times its factor in the infrared; one texel where it has no
/// texture) and its mip chain down to 1×1 by averages of 2×2 texels. Luma is 0.299 R + 0.587 G + 0.114 B (ITU-R
/// BT.601). Throws base::FaultError for a texture whose sides are no powers of two or whose bytes do not fit its sides.
std::vector<TextureLevel> TextureLevels(const geometry::Material& material, TextureKind kind);

}  // namespace alula::render::internal
