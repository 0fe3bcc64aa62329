#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/random.h"
#include "tests/fuzz/dataset_entry.h"
#include "tests/fuzz/faults_entry.h"
#include "tests/fuzz/jpeg_entry.h"
#include "tests/fuzz/mesh_entry.h"
#include "tests/fuzz/recording_entry.h"
#include "tests/fuzz/texture_entry.h"
#include "tests/fuzz/vocabulary_entry.h"
#include "tests/fuzz/yaml_entry.h"

namespace {

namespace fs = std::filesystem;

/// A parser's entry, its corpus, and what mutations insert.
struct Target {
  const char* name;
  void (*read)(const std::uint8_t* data, std::size_t size);
  void (*mend)(std::uint8_t* data, std::size_t size);  // after a mutation; may be null
  std::string_view bytes;
};

const Target kTargets[] = {
    {"yaml", &alula::fuzz::ReadYaml, nullptr, "[]{},:#&*!|>'\"%@`- \n\t019.eEkgm/\xc2\xb5\xff\\~?<"},
    {"faults", &alula::fuzz::ReadFaults, nullptr, "[]{},:#*'\"%- \n\t019.eEkgmsHz"},
    {"mesh", &alula::fuzz::ReadMesh, nullptr, "[]{},:\"/-+ \n\r\\#0123456789.eEvtnf=A\xff\x7f\x80\x01"},
    {"texture", &alula::fuzz::ReadTexture, &alula::fuzz::MendChecksums, "\x01\x02\x03\x04\x08\x10\x7f\x80\xff IDAT"},
    {"vocabulary", &alula::fuzz::ReadVocabulary, nullptr, "\x01\x02\x03\x08\x10\x7f\x80\xff"},
    {"dataset", &alula::fuzz::ReadDatasetFile, &alula::fuzz::MendChecksums,
     "[]{},:#\"%- \n\t019.eEnai\x01\x02\x08\x10\xff"},
    {"recording", &alula::fuzz::ReadRecordingFile, nullptr, "[]{},:#/-. \n\t0123456789eEPTx"},
    {"jpeg", &alula::fuzz::ReadJpeg, nullptr,
     "\xff\xd8\xc0\xc2\xc4\xda\xdb\xdd\xd9\xd0\x01\x02\x03\x11\x22\x3f\x10\x7f\x80"},
};

class FuzzCorpus : public ::testing::TestWithParam<Target> {
 protected:
  /// The files in the order of their names; without `laughs.yaml`, which expands to millions, for work in bulk.
  static std::vector<std::string> Corpus(bool in_bulk) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(fs::path("tests/fuzz/corpus") / GetParam().name)) {
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

  static void Read(const std::string& text) {
    GetParam().read(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  }

  static void Mutate(std::string& text, alula::base::RandomStream& random) {
    const std::string_view bytes = GetParam().bytes;
    for (std::uint64_t k = 1 + random.Index(4); k > 0 && !text.empty(); --k) {
      const auto at = static_cast<std::size_t>(random.Index(text.size()));
      const char byte = bytes[static_cast<std::size_t>(random.Index(bytes.size()))];
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
    if (GetParam().mend != nullptr) GetParam().mend(reinterpret_cast<std::uint8_t*>(text.data()), text.size());
  }
};

TEST_P(FuzzCorpus, DoesNoHarm) {
  const std::vector<std::string> corpus = Corpus(false);
  EXPECT_GT(corpus.size(), 5u);
  for (const std::string& text : corpus) Read(text);
}

TEST_P(FuzzCorpus, NeitherDoItsMutations) {
  alula::base::RandomStream random(1, "mutations");
  const std::vector<std::string> corpus = Corpus(true);
  for (int i = 0; i < 3000; ++i) {
    std::string text = corpus[static_cast<std::size_t>(random.Index(corpus.size()))];
    Mutate(text, random);
    SCOPED_TRACE(text);
    Read(text);
  }
}

INSTANTIATE_TEST_SUITE_P(Parsers, FuzzCorpus, ::testing::ValuesIn(kTargets),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
