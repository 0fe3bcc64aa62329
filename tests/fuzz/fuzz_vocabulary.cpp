#include "tests/fuzz/vocabulary_entry.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alula::fuzz::ReadVocabulary(data, size);
  return 0;
}
