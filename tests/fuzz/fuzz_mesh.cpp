#include "tests/fuzz/mesh_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alula::fuzz::ReadMesh(data, size);
  return 0;
}
