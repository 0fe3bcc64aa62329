#include "render/raster/packed_textures.h"

#include "render/internal/texture_levels.h"
#include "render/raster/morton.h"

namespace alula::render::raster {
namespace {

using internal::TextureLevel;

std::uint32_t Pack(const TextureLevel& level, int channels, int channel, int x, int y) {
  const auto texel = [&](int column, int row) {
    const auto wrapped = static_cast<std::size_t>((row % level.height) * level.width + column % level.width);
    return std::uint32_t{level.bytes[wrapped * static_cast<std::size_t>(channels) + static_cast<std::size_t>(channel)]};
  };
  return texel(x, y) | texel(x, y + 1) << 8 | texel(x + 1, y) << 16 | texel(x + 1, y + 1) << 24;
}

void Append(PackedTextures& packed, const std::vector<TextureLevel>& levels, int channels) {
  const TextureLevel& top = levels.front();
  TextureView view{};
  view.offset = static_cast<std::uint32_t>(packed.words[0].size());
  view.last_column = top.width - 1;
  view.last_row = top.height - 1;
  view.last_level = static_cast<std::int32_t>(levels.size()) - 1;
  const std::size_t length = ((std::size_t{4} << (2 * view.last_level)) - 1) / 3;  // of all levels together
  for (int channel = 0; channel < channels; ++channel) {
    Words& words = packed.words[static_cast<std::size_t>(channel)];
    words.resize(words.size() + length, 0);
    int k = view.last_level;
    for (const TextureLevel& level : levels) {
      const std::size_t start = view.offset + ((std::size_t{1} << (2 * k--)) - 1) / 3;
      for (int y = 0; y < level.height; ++y) {
        for (int x = 0; x < level.width; ++x) words[start + Morton(x, y)] = Pack(level, channels, channel, x, y);
      }
    }
  }
  packed.views.push_back(view);
}

}  // namespace

PackedTextures PackTextures(std::span<const geometry::Material> materials, int channels) {
  PackedTextures packed;
  for (const geometry::Material& material : materials) {
    Append(packed, internal::TextureLevels(material, channels), channels);
  }
  return packed;
}

}  // namespace alula::render::raster
