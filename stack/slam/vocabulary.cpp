#include "stack/slam/vocabulary.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string_view>

#include "base/error.h"

namespace alula::stack::slam {
namespace {

static_assert(std::endian::native == std::endian::little, "the vocabulary's file is little-endian");

constexpr std::string_view kMagic = "ALULAVOC";
constexpr std::uint32_t kMaxNodes = 10'000'000;

template <typename T>
void Put(std::vector<std::uint8_t>& bytes, const std::vector<T>& values) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(values.data());
  bytes.insert(bytes.end(), data, data + values.size() * sizeof(T));
}

void Put(std::vector<std::uint8_t>& bytes, const VocabularyTree& tree) {
  Put(bytes, std::vector<std::uint32_t>{static_cast<std::uint32_t>(tree.children.size()),
                                        static_cast<std::uint32_t>(tree.words())});
  Put(bytes, tree.children);
  Put(bytes, tree.centres);
  Put(bytes, tree.idf);
}

/// Takes values from the front of `rest`; false where there are too few.
template <typename T>
bool Take(std::span<const std::uint8_t>& rest, std::size_t count, std::vector<T>& values) {
  if (rest.size() / sizeof(T) < count) return false;
  values.resize(count);
  if (count > 0) std::memcpy(values.data(), rest.data(), count * sizeof(T));
  rest = rest.subspan(count * sizeof(T));
  return true;
}

bool Take(std::span<const std::uint8_t>& rest, VocabularyTree& tree) {
  std::vector<std::uint32_t> sizes;
  if (!Take(rest, 2, sizes) || sizes[0] > kMaxNodes || sizes[1] > sizes[0]) return false;
  if (!Take(rest, sizes[0], tree.children) || !Take(rest, sizes[0], tree.centres) || !Take(rest, sizes[1], tree.idf)) {
    return false;
  }
  for (const float f : tree.idf) {
    if (!std::isfinite(f) || f < 0) return false;
  }
  return tree.Index();
}

std::vector<features::Descriptor> DescriptorsOf(const auto& features) {
  std::vector<features::Descriptor> descriptors;
  descriptors.reserve(features.size());
  for (const auto& f : features) descriptors.push_back(f.descriptor);
  return descriptors;
}

}  // namespace

double Likeness(const BagOfWords& view, const BagOfWords& other) {
  const int count = view.point_count + view.line_count;
  if (count == 0) return 0.0;
  return (view.point_count * Likeness(view.points, other.points) +
          view.line_count * Likeness(view.lines, other.lines)) /
         count;
}

BagOfWords Vocabulary::WordsOf(const PlaceView& view) const {
  BagOfWords bag;
  bag.points = points.WordsOf(DescriptorsOf(view.points));
  bag.lines = lines.WordsOf(DescriptorsOf(view.lines));
  // What has no words has no say: a vocabulary without lines does not make all views less alike.
  bag.point_count = points.empty() ? 0 : static_cast<int>(view.points.size());
  bag.line_count = lines.empty() ? 0 : static_cast<int>(view.lines.size());
  return bag;
}

Vocabulary TrainVocabulary(const TrainingSet& images, const TreeShape& points, const TreeShape& lines,
                           std::uint64_t seed) {
  return {GrowTree(images.points, points, seed, "vocabulary/points"),
          GrowTree(images.lines, lines, seed, "vocabulary/lines")};
}

std::vector<std::uint8_t> ToBytes(const Vocabulary& vocabulary) {
  std::vector<std::uint8_t> bytes(kMagic.begin(), kMagic.end());
  Put(bytes, vocabulary.points);
  Put(bytes, vocabulary.lines);
  return bytes;
}

Vocabulary VocabularyFromBytes(std::span<const std::uint8_t> bytes, const std::string& name) {
  const bool ours = bytes.size() >= kMagic.size() && std::memcmp(bytes.data(), kMagic.data(), kMagic.size()) == 0;
  if (!ours) throw base::InputError(name + ": is no vocabulary; `alula slam train-vocabulary` makes one");
  std::span<const std::uint8_t> rest = bytes.subspan(kMagic.size());
  Vocabulary vocabulary;
  if (!Take(rest, vocabulary.points) || !Take(rest, vocabulary.lines) || !rest.empty()) {
    throw base::InputError(name + ": a broken vocabulary; `alula slam train-vocabulary` makes a new one");
  }
  return vocabulary;
}

Vocabulary LoadVocabulary(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  if (!stream) throw base::InputError(file.string() + ": cannot be read; expected a vocabulary");
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(stream.tellg()));
  stream.seekg(0);
  if (!stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
    throw base::InputError(file.string() + ": cannot be read to its end");
  }
  return VocabularyFromBytes(bytes, file.string());
}

std::filesystem::path VocabularyPath() { return std::filesystem::path(ALULA_SLAM_ASSETS) / "vocabulary.bin"; }

std::shared_ptr<const Vocabulary> SharedVocabulary() {
  static const auto shared = std::make_shared<const Vocabulary>(LoadVocabulary(VocabularyPath()));
  return shared;
}

}  // namespace alula::stack::slam
