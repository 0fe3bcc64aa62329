#include "scenarios/dataset/jpeg.h"

#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <utility>
#include <vector>

// jpeglib.h wants <cstdio> before it.
#include <jpeglib.h>

#include "base/error.h"

// libjpeg reports errors by a function that may not return. No function that calls setjmp here owns anything with a
// destructor: what they work on belongs to their callers.
namespace alula::scenarios::dataset {
namespace {

constexpr std::uint64_t kMostPixels = 1ULL << 26;
/// A progressive file may repeat its picture in scans without end, each a few bytes long.
constexpr int kMostScans = 100;

struct Reading {
  jpeg_error_mgr errors{};
  std::jmp_buf out{};
  std::array<char, JMSG_LENGTH_MAX> message{};
  jpeg_decompress_struct jpeg{};
  jpeg_progress_mgr progress{};
  bool made = false;
  stack::Image image;
  std::vector<std::uint8_t> bytes;

  ~Reading() {
    if (made) jpeg_destroy_decompress(&jpeg);
  }
};

[[noreturn]] void TakeError(j_common_ptr jpeg) {
  auto& r = *static_cast<Reading*>(jpeg->client_data);
  jpeg->err->format_message(jpeg, r.message.data());
  std::longjmp(r.out, 1);
}

/// A warning (level −1) is damage that the library would paper over with grey.
void TakeMessage(j_common_ptr jpeg, int level) {
  if (level < 0) TakeError(jpeg);
}

void LimitScans(j_common_ptr jpeg) {
  if (reinterpret_cast<j_decompress_ptr>(jpeg)->input_scan_number <= kMostScans) return;
  auto& r = *static_cast<Reading*>(jpeg->client_data);
  std::snprintf(r.message.data(), r.message.size(), "more than %d scans", kMostScans);
  std::longjmp(r.out, 1);
}

/// Reads the header and sizes the image.
bool DecodeHeader(Reading& r, std::string_view bytes) {
  r.jpeg.err = jpeg_std_error(&r.errors);
  r.errors.error_exit = TakeError;
  r.errors.emit_message = TakeMessage;
  r.jpeg.client_data = &r;
  if (setjmp(r.out) != 0) return false;
  jpeg_create_decompress(&r.jpeg);  // keeps err and client_data
  r.made = true;
  r.progress.progress_monitor = LimitScans;
  r.jpeg.progress = &r.progress;
  jpeg_mem_src(&r.jpeg, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_read_header(&r.jpeg, TRUE);
  if (std::uint64_t{r.jpeg.image_width} * r.jpeg.image_height > kMostPixels) {
    std::snprintf(r.message.data(), r.message.size(), "more than 67 million pixels");
    return false;
  }
  const bool grey = r.jpeg.jpeg_color_space == JCS_GRAYSCALE;
  r.jpeg.out_color_space = grey ? JCS_GRAYSCALE : JCS_RGB;
  r.jpeg.dct_method = JDCT_ISLOW;
  r.image.format = grey ? stack::PixelFormat::kGrey8 : stack::PixelFormat::kRgb8;
  r.image.width = static_cast<int>(r.jpeg.image_width);
  r.image.height = static_cast<int>(r.jpeg.image_height);
  r.image.stride = r.image.width * (grey ? 1 : 3);
  return true;
}

bool DecodeRows(Reading& r) {
  if (setjmp(r.out) != 0) return false;
  jpeg_start_decompress(&r.jpeg);
  while (r.jpeg.output_scanline < r.jpeg.output_height) {
    JSAMPROW row =
        r.bytes.data() + static_cast<std::size_t>(r.jpeg.output_scanline) * static_cast<std::size_t>(r.image.stride);
    jpeg_read_scanlines(&r.jpeg, &row, 1);
  }
  jpeg_finish_decompress(&r.jpeg);
  return true;
}

}  // namespace

bool LooksLikeJpeg(std::string_view bytes) { return bytes.starts_with("\xff\xd8"); }

stack::Image DecodeJpeg(std::string_view bytes, const std::string& name) {
  Reading r;
  if (!DecodeHeader(r, bytes)) {
    throw base::InputError({name}, "", "is no JPEG image that can be read (" + std::string(r.message.data()) + ")");
  }
  // A block of 64 samples takes at least one bit for each of its two parts: a header that promises more lies, and is
  // not worth the memory.
  constexpr std::uint64_t kMostPacked = 64 * 8;
  if (std::uint64_t{r.jpeg.image_width} * r.jpeg.image_height / kMostPacked > bytes.size()) {
    throw base::InputError({name}, "", "is a broken JPEG image (the file ends early)");
  }
  r.bytes.resize(static_cast<std::size_t>(r.image.stride) * static_cast<std::size_t>(r.image.height));
  if (!DecodeRows(r)) {
    throw base::InputError({name}, "", "is a broken JPEG image (" + std::string(r.message.data()) + ")");
  }
  r.image.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(r.bytes));
  return std::move(r.image);
}

}  // namespace alula::scenarios::dataset
