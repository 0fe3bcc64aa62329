#include "tests/fuzz/faults_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alula::fuzz::ReadFaults(data, size);
  return 0;
}
