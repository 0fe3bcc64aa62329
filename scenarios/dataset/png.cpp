#include "scenarios/dataset/png.h"

#include <png.h>

#include <csetjmp>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>
#include <utility>

#include "base/error.h"

// libpng reports errors by longjmp. No function that calls setjmp here owns anything with a destructor: what they work
// on belongs to their callers.
namespace alula::scenarios::dataset {
namespace {

constexpr std::uint32_t kLargestSide = 1U << 15;
constexpr std::uint64_t kMostPixels = 1ULL << 26;

struct Writing {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string bytes;
  std::string error;

  ~Writing() { png_destroy_write_struct(&png, &info); }
};

struct Reading {
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string_view rest;
  std::string error;
  PngImage image;
  std::vector<png_bytep> rows;

  ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void TakeError(png_structp png, png_const_charp message) {
  static_cast<std::string*>(png_get_error_ptr(png))->assign(message);
  png_longjmp(png, 1);
}
void IgnoreWarning(png_structp, png_const_charp) {}

void Append(png_structp png, png_bytep data, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}
void Flush(png_structp) {}

void Take(png_structp png, png_bytep data, std::size_t size) {
  auto& rest = *static_cast<std::string_view*>(png_get_io_ptr(png));
  if (size > rest.size()) png_error(png, "the file ends early");
  std::memcpy(data, rest.data(), size);
  rest.remove_prefix(size);
}

/// What is to be packed: rows of `stride` bytes.
struct Source {
  int width, height, channels, depth;
  const std::uint8_t* first;
  std::size_t stride;
};

bool Encode(Writing& w, const Source& source) {
  w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &w.error, TakeError, IgnoreWarning);
  if (w.png == nullptr) return false;
  w.info = png_create_info_struct(w.png);
  if (w.info == nullptr || setjmp(png_jmpbuf(w.png)) != 0) return false;
  png_set_write_fn(w.png, &w.bytes, Append, Flush);
  png_set_IHDR(w.png, w.info, static_cast<png_uint_32>(source.width), static_cast<png_uint_32>(source.height),
               source.depth, source.channels == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_level(w.png, 1);
  // Sensor noise leaves zlib nothing to match, only bytes of unlike frequency (Z_HUFFMAN_ONLY: 2.2 ms a 640×480 image
  // and a smaller file than the default's 4.0 ms). Depth has flat stretches where nothing was measured (Z_RLE).
  png_set_compression_strategy(w.png, source.depth == 8 ? 2 : 3);
  png_set_filter(w.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
  png_write_info(w.png, w.info);
  if (source.depth == 16) png_set_swap(w.png);  // PNG is big-endian, this machine is not
  for (int row = 0; row < source.height; ++row) {
    png_write_row(w.png, source.first + static_cast<std::size_t>(row) * source.stride);
  }
  png_write_end(w.png, w.info);
  return true;
}

std::string Encode(const Source& source) {
  Writing w;
  if (!Encode(w, source)) throw base::FaultError("dataset", "libpng: " + w.error);
  return std::move(w.bytes);
}

/// Reads the header, asks libpng for what PngImage can hold, and sizes it.
bool DecodeHeader(Reading& r) {
  r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r.error, TakeError, IgnoreWarning);
  if (r.png == nullptr) return false;
  r.info = png_create_info_struct(r.png);
  if (r.info == nullptr || setjmp(png_jmpbuf(r.png)) != 0) return false;
  png_set_read_fn(r.png, &r.rest, Take);
  png_set_user_limits(r.png, kLargestSide, kLargestSide);
  png_read_info(r.png, r.info);
  if (std::uint64_t{png_get_image_width(r.png, r.info)} * png_get_image_height(r.png, r.info) > kMostPixels) {
    png_error(r.png, "more than 67 million pixels");
  }
  png_set_expand(r.png);  // palettes, fewer than 8 bits
  png_set_strip_alpha(r.png);
  if (png_get_bit_depth(r.png, r.info) == 16) png_set_swap(r.png);
  png_set_interlace_handling(r.png);
  png_read_update_info(r.png, r.info);
  r.image.width = static_cast<int>(png_get_image_width(r.png, r.info));
  r.image.height = static_cast<int>(png_get_image_height(r.png, r.info));
  r.image.channels = png_get_channels(r.png, r.info);
  r.image.depth = png_get_bit_depth(r.png, r.info);
  return true;
}

bool DecodeRows(Reading& r) {
  if (setjmp(png_jmpbuf(r.png)) != 0) return false;
  png_read_image(r.png, r.rows.data());
  png_read_end(r.png, nullptr);
  return true;
}

}  // namespace

std::string EncodePng(const stack::Image& image) {
  return Encode({image.width, image.height, image.format == stack::PixelFormat::kGrey8 ? 1 : 3, 8, image.bytes->data(),
                 static_cast<std::size_t>(image.stride)});
}

std::string EncodePng16(int width, int height, const std::vector<std::uint16_t>& values) {
  return Encode({width, height, 1, 16, reinterpret_cast<const std::uint8_t*>(values.data()),
                 static_cast<std::size_t>(width) * 2});
}

PngImage DecodePng(std::string_view bytes, const std::string& name) {
  Reading r;
  r.rest = bytes;
  if (!DecodeHeader(r)) throw base::InputError({name}, "", "is no PNG image that can be read (" + r.error + ")");
  const std::size_t stride = png_get_rowbytes(r.png, r.info);
  // Deflate packs at most 1032 to 1: a header that promises more lies, and is not worth the memory.
  constexpr std::size_t kMostPacked = 1032;
  if (stride * static_cast<std::size_t>(r.image.height) / kMostPacked > bytes.size()) {
    throw base::InputError({name}, "", "is a broken PNG image (the file ends early)");
  }
  r.image.bytes.resize(stride * static_cast<std::size_t>(r.image.height));
  for (int v = 0; v < r.image.height; ++v)
    r.rows.push_back(r.image.bytes.data() + static_cast<std::size_t>(v) * stride);
  if (!DecodeRows(r)) throw base::InputError({name}, "", "is a broken PNG image (" + r.error + ")");
  return std::move(r.image);
}

PngImage ReadPng(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream bytes;
  if (!stream || !(bytes << stream.rdbuf())) throw base::InputError({file.string()}, "", "cannot be read");
  return DecodePng(bytes.str(), file.string());
}

stack::Image ToImage(PngImage png, const std::string& name) {
  if (png.depth != 8) throw base::InputError({name}, "", "has 16 bits a pixel; a camera's image has 8");
  stack::Image image;
  image.format = png.channels == 1 ? stack::PixelFormat::kGrey8 : stack::PixelFormat::kRgb8;
  image.width = png.width;
  image.height = png.height;
  image.stride = png.width * png.channels;
  image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(png.bytes));
  return image;
}

}  // namespace alula::scenarios::dataset
