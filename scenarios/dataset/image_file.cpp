#include "scenarios/dataset/image_file.h"

#include <cmath>
#include <cstring>
#include <utility>

#include "base/error.h"
#include "scenarios/dataset/internal/files.h"
#include "scenarios/dataset/jpeg.h"
#include "scenarios/dataset/png.h"

namespace alula::scenarios::dataset {
namespace {

constexpr std::string_view kWanted = "an image, PNG or JPEG, is wanted";

void CheckSize(const std::filesystem::path& file, int width, int height, const stack::CameraCalibration& camera) {
  const stack::CameraIntrinsics& c = camera.intrinsics;
  if (width == c.width && height == c.height) return;
  throw base::InputError({file.string()}, "",
                         "is " + std::to_string(width) + "x" + std::to_string(height) +
                             " pixels; the calibration of its camera says " + std::to_string(c.width) + "x" +
                             std::to_string(c.height));
}

std::vector<std::uint16_t> Millimetres(const PngImage& png, double values_per_metre) {
  std::vector<std::uint16_t> values(png.bytes.size() / 2);
  std::memcpy(values.data(), png.bytes.data(), png.bytes.size());
  const double scale = 1000.0 / values_per_metre;
  for (std::uint16_t& value : values) {
    const double millimetres = std::round(value * scale);
    const bool measured = value != UINT16_MAX && millimetres <= UINT16_MAX;
    value = measured ? static_cast<std::uint16_t>(millimetres) : std::uint16_t{0};
  }
  return values;
}

}  // namespace

stack::Image ReadImage(const std::filesystem::path& file) {
  const std::string bytes = internal::ReadWhole(file, kWanted);
  if (LooksLikeJpeg(bytes)) return DecodeJpeg(bytes, file.string());
  return ToImage(DecodePng(bytes, file.string()), file.string());
}

stack::Image LoadImage(const ImageFile& image, const stack::CameraCalibration& camera) {
  stack::Image loaded = ReadImage(image.file);
  CheckSize(image.file, loaded.width, loaded.height, camera);
  loaded.exposure_start = image.captured;
  return loaded;
}

stack::DepthImage LoadDepth(const ImageFile& image, const stack::CameraCalibration& camera, double values_per_metre) {
  const PngImage png = DecodePng(internal::ReadWhole(image.file, "a 16-bit PNG is wanted"), image.file.string());
  if (png.depth != 16 || png.channels != 1) {
    throw base::InputError({image.file.string()}, "",
                           "has " + std::to_string(png.channels) + " channels of " + std::to_string(png.depth) +
                               " bits; a depth image has one of 16");
  }
  CheckSize(image.file, png.width, png.height, camera);
  return {.width = png.width,
          .height = png.height,
          .exposure_start = image.captured,
          .exposure = {},
          .millimetres = std::make_shared<const std::vector<std::uint16_t>>(Millimetres(png, values_per_metre))};
}

}  // namespace alula::scenarios::dataset
