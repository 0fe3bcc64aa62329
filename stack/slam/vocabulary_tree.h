#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "stack/features/descriptor.h"

namespace alula::stack::slam {

/// A word of an image with its weight.
struct WeightedWord {
  std::uint32_t word = 0;
  float weight = 0.0F;
  bool operator==(const WeightedWord&) const = default;
};
/// Ascending in the word; weights are positive and sum to 1.
using WordVector = std::vector<WeightedWord>;

/// Likeness of two images by their words, 1 − ½ Σ |v_i − w_i| in [0, 1]: with weights that are positive and sum to 1 it
/// is Σ min(v_i, w_i) (Gálvez-López and Tardós 2012, eq. 2; P4).
double Likeness(const WordVector& v, const WordVector& w);

/// How a tree is grown.
struct TreeShape {
  int branching = 10;   // children of a node
  int levels = 4;       // 10⁴ words at most
  int iterations = 10;  // of k-medians a node; fewer where nothing moves any more
};

/// A tree of clusters of binary descriptors (Nistér and Stewénius 2006; Gálvez-López and Tardós 2012): a node's centre
/// has the majority's bits; leaves are words. Plain arrays, nodes breadth first, node 0 the root, a node's children one
/// after another.
struct VocabularyTree {
  std::vector<std::uint8_t> children;         // [nodes] how many; 0: a leaf
  std::vector<features::Descriptor> centres;  // [nodes]; the root's is not used
  std::vector<float> idf;                  // [words] ln(N / N_i): images of the training, and those that had the word
  std::vector<std::uint32_t> first_child;  // [nodes], made from `children`
  std::vector<std::uint32_t> word_of;      // [nodes], of leaves: which word

  /// Fills the last two. False where the arrays do not make a tree.
  bool Index();
  std::size_t words() const { return idf.size(); }
  bool empty() const { return words() == 0; }

  /// The leaf that is reached by going to the nearest child from the root on; of equal ones the first.
  std::uint32_t WordOf(const features::Descriptor& descriptor) const;
  /// tf-idf: weight_i ∝ n_i idf_i, n_i times that the word is seen. Empty for an image without words that weigh.
  WordVector WordsOf(std::span<const features::Descriptor> descriptors) const;
};

/// Grows a tree from the descriptors of images (for idf: one list an image) by k-medians in each node, begun as
/// k-means++ does (Arthur and Vassilvitskii 2007) with the stream `name` of the seed. The same input gives the same
/// tree. A node with too few descriptors for as many children as `branching` stays a leaf. Empty where there are none.
VocabularyTree GrowTree(const std::vector<std::vector<features::Descriptor>>& images, const TreeShape& shape,
                        std::uint64_t seed, std::string_view name);

}  // namespace alula::stack::slam
