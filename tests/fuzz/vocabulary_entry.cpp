#include "tests/fuzz/vocabulary_entry.h"

#include <algorithm>

#include "base/error.h"
#include "stack/slam/vocabulary.h"
#include "tests/fuzz/expect.h"

namespace alula::fuzz {

void ReadVocabulary(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> bytes(data, size);
  try {
    const stack::slam::Vocabulary vocabulary = stack::slam::VocabularyFromBytes(bytes, "input.bin");
    Expect(std::ranges::equal(stack::slam::ToBytes(vocabulary), bytes), "goes back to the same bytes");
    for (const stack::slam::VocabularyTree* tree : {&vocabulary.points, &vocabulary.lines}) {
      for (const std::uint64_t word : {0ULL, ~0ULL, 0x5555555555555555ULL}) {
        const stack::features::Descriptor descriptor{word, word, ~word, word};
        if (!tree->empty()) Expect(tree->WordOf(descriptor) < tree->words(), "a word of the tree");
      }
    }
  } catch (const base::InputError& error) {
    ExpectOneLine(error.what());
  }
}

}  // namespace alula::fuzz
