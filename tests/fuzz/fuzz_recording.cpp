#include "tests/fuzz/recording_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alula::fuzz::ReadRecordingFile(data, size);
  return 0;
}
