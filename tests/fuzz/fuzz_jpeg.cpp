#include "tests/fuzz/jpeg_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alula::fuzz::ReadJpeg(data, size);
  return 0;
}
