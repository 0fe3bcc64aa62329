#include "render/raster/packed_textures.h"

#include "render/internal/texture_levels.h"

namespace alula::render::raster {
namespace {

using internal::TextureLevel;

/// One level's words of one channel, from `words` on.
void Pack(const TextureLevel& level, int channels, int channel, std::int32_t pitch, std::uint16_t* words) {
  const auto row_of = [&](int y) {
    return level.bytes.data() + (y & (level.height - 1)) * level.width * channels + channel;  // sides are powers of two
  };
  for (int y = 0; y < level.height; ++y) {
    const std::uint8_t* row = row_of(y);
    const std::uint8_t* above = row_of(y + 1);
    std::uint16_t* out = words + std::ptrdiff_t{y} * pitch;
    for (int x = 0; x < level.width; ++x) {
      out[x] = static_cast<std::uint16_t>(row[x * channels] | above[x * channels] << 8);
    }
    out[level.width] = out[0];
  }
}

void Append(PackedTextures& packed, const std::vector<TextureLevel>& levels, int channels) {
  const TextureLevel& top = levels.front();
  const auto count = static_cast<std::int32_t>(levels.size());
  TextureView view{};
  view.offset = static_cast<std::int32_t>(packed.words[0].size());
  view.last_column = top.width - 1;
  view.last_row = top.height - 1;
  view.last_level = static_cast<float>(count - 1);
  view.skip = 2 * top.width;
  view.pitch = view.skip + 2 * count + 2;  // the level beyond the last begins inside too
  const std::size_t length = static_cast<std::size_t>(view.pitch) * static_cast<std::size_t>(top.height);
  for (int channel = 0; channel < channels; ++channel) {
    std::vector<std::uint16_t>& words = packed.words[static_cast<std::size_t>(channel)];
    words.resize(words.size() + length);
    for (std::int32_t l = 0; l < count; ++l) {
      const std::int32_t column = view.skip - (view.skip >> l) + 2 * l;
      Pack(levels[static_cast<std::size_t>(l)], channels, channel, view.pitch, words.data() + view.offset + column);
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
