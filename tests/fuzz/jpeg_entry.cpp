#include "tests/fuzz/jpeg_entry.h"

#include <string_view>

#include "scenarios/dataset/image_file.h"
#include "scenarios/dataset/jpeg.h"
#include "stack/interface/grey.h"
#include "tests/fuzz/expect.h"

namespace alula::fuzz {

void ReadJpeg(const std::uint8_t* data, std::size_t size) {
  Try([&] {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const stack::Image image = scenarios::dataset::DecodeJpeg(bytes, "image");
    Expect(image.width > 0 && image.height > 0, "an empty image");
    Expect(image.bytes->size() == static_cast<std::size_t>(image.stride) * static_cast<std::size_t>(image.height),
           "number of bytes");
    const stack::Image grey = stack::ToGrey(image);
    Expect(grey.bytes->size() == static_cast<std::size_t>(grey.width) * static_cast<std::size_t>(grey.height),
           "number of grey bytes");
  });
}

}  // namespace alula::fuzz
