#include "render/raster/packed_textures.h"

#include "render/raster/morton.h"

namespace alula::render::raster {
namespace {

using internal::TextureLevel;

/// One level's words of one channel, from `words` on.
void Pack(const TextureLevel& level, int channels, int channel, std::uint32_t* words) {
  const auto row_of = [&](int y) {
    return level.bytes.data() + (y & (level.height - 1)) * level.width * channels + channel;
  };
  for (int y = 0; y < level.height; ++y) {
    const std::uint8_t* row = row_of(y);
    const std::uint8_t* above = row_of(y + 1);
    for (int x = 0; x < level.width; ++x) {
      const int here = x * channels;
      const int right = ((x + 1) & (level.width - 1)) * channels;  // sides are powers of two
      words[Morton(x, y)] = std::uint32_t{row[here]} | std::uint32_t{above[here]} << 8 |
                            std::uint32_t{row[right]} << 16 | std::uint32_t{above[right]} << 24;
    }
  }
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
    std::vector<std::uint32_t>& words = packed.words[static_cast<std::size_t>(channel)];
    words.resize(words.size() + length, 0);
    int k = view.last_level;
    for (const TextureLevel& level : levels) {
      Pack(level, channels, channel, words.data() + view.offset + ((std::size_t{1} << (2 * k--)) - 1) / 3);
    }
  }
  packed.views.push_back(view);
}

}  // namespace

PackedTextures PackTextures(std::span<const geometry::Material> materials, internal::TextureKind kind) {
  PackedTextures packed;
  for (const geometry::Material& material : materials) {
    Append(packed, internal::TextureLevels(material, kind), internal::ChannelsOf(kind));
  }
  return packed;
}

PackedTextures PackAlpha(std::span<const geometry::Material> materials) {
  PackedTextures packed;
  for (const geometry::Material& material : materials) {
    if (geometry::HasHoles(material)) {
      Append(packed, internal::AlphaLevels(material), 1);
    } else {
      packed.views.push_back({});
    }
  }
  return packed;
}

}  // namespace alula::render::raster
