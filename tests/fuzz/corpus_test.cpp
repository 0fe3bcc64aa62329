#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/random.h"
#include "tests/fuzz/yaml_entry.h"

namespace {

namespace fs = std::filesystem;

/// The files in the order of their names; without `laughs.yaml`, which expands to millions, for work in bulk.
std::vector<std::string> Corpus(bool in_bulk) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator("tests/fuzz/corpus/yaml")) {
    if (!in_bulk || entry.path().filename() != "laughs.yaml") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts;
  for (const fs::path& file : files) {
    std::ifstream stream(file, std::ios::binary);
    texts.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
  }
  return texts;
}

void Read(const std::string& text) {
  alula::fuzz::ReadYaml(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
}

TEST(FuzzYaml, TheCorpusDoesNoHarm) {
  const std::vector<std::string> corpus = Corpus(false);
  EXPECT_GT(corpus.size(), 5u);
  for (const std::string& text : corpus) Read(text);
}

TEST(FuzzYaml, NeitherDoItsMutations) {
  alula::base::RandomStream random(1, "mutations");
  const std::vector<std::string> corpus = Corpus(true);
  constexpr std::string_view kBytes = "[]{},:#&*!|>'\"%@`- \n\t019.eEkgm/\xc2\xb5\xff\\~?<";
  for (int i = 0; i < 3000; ++i) {
    std::string text = corpus[static_cast<std::size_t>(random.Index(corpus.size()))];
    for (std::uint64_t k = 1 + random.Index(4); k > 0 && !text.empty(); --k) {
      const auto at = static_cast<std::size_t>(random.Index(text.size()));
      const char byte = kBytes[static_cast<std::size_t>(random.Index(kBytes.size()))];
      switch (random.Index(4)) {
        case 0:
          text[at] = byte;
          break;
        case 1:
          text.insert(at, 1, byte);
          break;
        case 2:
          text.erase(at, 1 + static_cast<std::size_t>(random.Index(8)));
          break;
        default:
          text += text.substr(at, 16);
      }
    }
    SCOPED_TRACE(text);
    Read(text);
  }
}

}  // namespace
