#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "stack/interface/measurement.h"

namespace alula::scenarios::dataset {

/// An image as PNG holds it: rows from the top without gaps; 16-bit samples in the machine's byte order.
struct PngImage {
  int width = 0;
  int height = 0;
  int channels = 1;  // 1 grey, 3 RGB
  int depth = 8;     // bits a channel, 8 or 16
  std::vector<std::uint8_t> bytes;
};

/// PNG files as bytes, packed for speed rather than for size. Lossless.
std::string EncodePng(const stack::Image& image);
/// 16-bit grey, `width` · `height` values.
std::string EncodePng16(int width, int height, const std::vector<std::uint16_t>& values);

/// Reads a PNG file's bytes: grey or colour, of 8 or 16 bits; palettes are resolved and alpha is dropped. `name` goes
/// into the message. Throws base::InputError for anything else, broken files and images of more than 2²⁶ pixels.
PngImage DecodePng(std::string_view bytes, const std::string& name);
PngImage ReadPng(const std::filesystem::path& file);

/// A decoded 8-bit image as a camera's; nothing is known of its exposure. Throws base::InputError for 16 bits.
stack::Image ToImage(PngImage png, const std::string& name);

}  // namespace alula::scenarios::dataset
