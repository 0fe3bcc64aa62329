#include "tests/fuzz/dataset_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alula::fuzz::ReadDatasetFile(data, size);
  return 0;
}
