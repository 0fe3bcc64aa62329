#include "tests/fuzz/yaml_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alula::fuzz::ReadYaml(data, size);
  return 0;
}
