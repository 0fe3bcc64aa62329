#include "stack/interface/grey.h"

#include <utility>

namespace alula::stack {

Image ToGrey(const Image& image) {
  if (image.format == PixelFormat::kGrey8) return image;
  // Weights of sum 2¹⁶; half of that is added to round.
  constexpr std::uint32_t kRed = 19595, kGreen = 38470, kBlue = 7471, kHalf = 1U << 15;
  std::vector<std::uint8_t> grey(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::uint8_t* out = grey.data();
  for (int v = 0; v < image.height; ++v) {
    const std::uint8_t* rgb = image.Row(v);
    for (int u = 0; u < image.width; ++u, rgb += 3) {
      *out++ = static_cast<std::uint8_t>((kRed * rgb[0] + kGreen * rgb[1] + kBlue * rgb[2] + kHalf) >> 16);
    }
  }
  Image result = image;
  result.format = PixelFormat::kGrey8;
  result.stride = image.width;
  result.bytes = std::make_shared<const std::vector<std::uint8_t>>(std::move(grey));
  return result;
}

}  // namespace alula::stack
