#include "geometry/load_texture.h"

#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "geometry/internal/file_bytes.h"
#include "geometry/internal/parse_texture.h"

namespace alula::geometry {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = 64UL << 20U;  // of a PNG file; 4096² texels take 50 MB when nothing can be packed

/// A picture as the file has it: RGBA, rows from the top.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
};

/// libpng's reader, freed whatever happens.
struct Reader {
  Reader() { image.version = PNG_IMAGE_VERSION; }
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_image_free(&image); }
  png_image image{};
};

Picture ReadPng(std::string_view bytes, const fs::path& file) {
  constexpr std::string_view kSignature("\x89PNG\r\n\x1a\n", 8);
  if (!bytes.starts_with(kSignature)) internal::FailIn(file, "is no PNG file; convert the texture to PNG");
  Reader reader;
  const auto broken = [&] {
    internal::FailIn(file, "cannot be read as PNG: " + internal::Shown(reader.image.message) + "; the file is broken");
  };
  if (png_image_begin_read_from_memory(&reader.image, bytes.data(), bytes.size()) == 0) broken();
  const png_uint_32 largest = std::max(reader.image.width, reader.image.height);
  if (largest > static_cast<png_uint_32>(kMostTexels)) {
    internal::FailIn(file, "is " + std::to_string(reader.image.width) + " x " + std::to_string(reader.image.height) +
                               " texels; at most " + std::to_string(kMostTexels) + " a side are read");
  }
  reader.image.format = PNG_FORMAT_RGBA;
  Picture picture{static_cast<int>(reader.image.width), static_cast<int>(reader.image.height), {}};
  picture.rgba.resize(PNG_IMAGE_SIZE(reader.image));
  if (png_image_finish_read(&reader.image, nullptr, picture.rgba.data(), 0, nullptr) == 0) broken();
  // Warnings are about chunks besides the picture (profiles, times); they change no texel.
  return picture;
}

/// Which two texels of `from` the centre of texel `to` of `to_size` lies between, and the share of the second.
struct Between {
  int first;
  int second;
  float share;
};
std::vector<Between> Stretch(int from_size, int to_size) {
  std::vector<Between> weights;
  for (int to = 0; to < to_size; ++to) {
    const double at = (to + 0.5) * from_size / to_size - 0.5;
    const double low = std::floor(at);
    const int first = (static_cast<int>(low) + from_size) % from_size;
    weights.push_back({first, (first + 1) % from_size, static_cast<float>(at - low)});
  }
  return weights;
}

}  // namespace

Texture internal::ParseTexture(std::string_view bytes, const fs::path& file) {
  const Picture from = ReadPng(bytes, file);
  bool opaque = true;
  for (std::size_t i = 3; i < from.rgba.size(); i += 4) opaque = opaque && from.rgba[i] >= 128;
  Texture texture;
  texture.width = static_cast<int>(std::bit_ceil(static_cast<unsigned>(from.width)));
  texture.height = static_cast<int>(std::bit_ceil(static_cast<unsigned>(from.height)));
  const std::vector<Between> columns = Stretch(from.width, texture.width);
  const std::vector<Between> rows = Stretch(from.height, texture.height);
  texture.rgb.reserve(3UL * columns.size() * rows.size());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {  // ours begin at the foot
    const std::size_t width = static_cast<std::size_t>(from.width);
    const std::uint8_t* upper = from.rgba.data() + 4 * width * static_cast<std::size_t>(row->first);
    const std::uint8_t* lower = from.rgba.data() + 4 * width * static_cast<std::size_t>(row->second);
    for (const Between& column : columns) {
      for (int c = 0; c < (opaque ? 3 : 4); ++c) {
        const auto across = [&](const std::uint8_t* line) {
          const float a = line[4 * column.first + c];
          return a + column.share * (static_cast<float>(line[4 * column.second + c]) - a);
        };
        const float above = across(upper);
        const auto value = static_cast<std::uint8_t>(std::lround(above + row->share * (across(lower) - above)));
        (c < 3 ? texture.rgb : texture.alpha).push_back(value);
      }
    }
  }
  return texture;
}

Texture LoadTexture(const fs::path& file) {
  return internal::ParseTexture(internal::ReadWhole(file, "texture", kMostBytes), file);
}

}  // namespace alula::geometry
