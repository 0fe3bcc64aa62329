#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

#include "stack/slam/place_view.h"
#include "stack/slam/vocabulary_tree.h"

namespace alula::stack::slam {

/// The words of a view: of its points and of its lines apart.
struct BagOfWords {
  WordVector points, lines;
  int point_count = 0, line_count = 0;  // features that gave them: the weights of the two
};

/// Likeness of two views in [0, 1]: s = (N_p s_p + N_l s_l)/(N_p + N_l) with the L1 scores of points and lines and the
/// numbers of features of `view` (P4, section 2.3.1).
double Likeness(const BagOfWords& view, const BagOfWords& other);

/// One tree over points and one over lines; either may be empty.
struct Vocabulary {
  VocabularyTree points, lines;

  BagOfWords WordsOf(const PlaceView& view) const;
};

/// Descriptors of the points and lines of the training's images, one list an image.
struct TrainingSet {
  std::vector<std::vector<features::Descriptor>> points, lines;
};

/// Both trees by GrowTree, the streams "vocabulary/points" and "vocabulary/lines" of the seed.
Vocabulary TrainVocabulary(const TrainingSet& images, const TreeShape& points, const TreeShape& lines,
                           std::uint64_t seed);

/// The file: "ALULAVOC", then for points and for lines: u32 nodes, u32 words, u8 children of each node, 32 bytes centre
/// of each node, f32 idf of each word; little-endian.
std::vector<std::uint8_t> ToBytes(const Vocabulary& vocabulary);
/// Throws base::InputError, with `name` in front, where the bytes are no vocabulary.
Vocabulary VocabularyFromBytes(std::span<const std::uint8_t> bytes, const std::string& name);
/// Reads a file. Throws base::InputError where it is missing or broken.
Vocabulary LoadVocabulary(const std::filesystem::path& file);

/// The vocabulary that Alula ships, and where it is.
std::filesystem::path VocabularyPath();
/// Read once in a process. Throws as LoadVocabulary does.
std::shared_ptr<const Vocabulary> SharedVocabulary();

}  // namespace alula::stack::slam
