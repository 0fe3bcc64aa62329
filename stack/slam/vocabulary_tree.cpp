#include "stack/slam/vocabulary_tree.h"

#include <algorithm>
#include <array>
#include <limits>

namespace alula::stack::slam {

using features::Descriptor;

double Likeness(const WordVector& v, const WordVector& w) {
  double sum = 0.0;
  for (auto a = v.begin(), b = w.begin(); a != v.end() && b != w.end();) {
    if (a->word < b->word) {
      ++a;
    } else if (b->word < a->word) {
      ++b;
    } else {
      sum += std::min((a++)->weight, (b++)->weight);
    }
  }
  return sum;
}

bool VocabularyTree::Index() {
  const std::size_t nodes = children.size();
  if (centres.size() != nodes) return false;
  first_child.assign(nodes, 0);
  word_of.assign(nodes, 0);
  std::uint64_t next = 1;
  std::uint32_t word = 0;
  for (std::size_t n = 0; n < nodes; ++n) {
    if (children[n] == 0) {
      word_of[n] = word++;
      continue;
    }
    if (next <= n) return false;  // its own ancestor
    first_child[n] = static_cast<std::uint32_t>(next);
    next += children[n];
  }
  return nodes == 0 ? idf.empty() : next == nodes && word == idf.size();
}

std::uint32_t VocabularyTree::WordOf(const Descriptor& descriptor) const {
  std::array<std::uint16_t, 256> distances{};
  std::size_t node = 0;
  while (children[node] > 0) {
    const std::span<const Descriptor> family(&centres[first_child[node]], children[node]);
    features::HammingDistances(descriptor, family, std::span(distances).first(family.size()));
    const auto nearest = std::min_element(distances.begin(), distances.begin() + children[node]);
    node = first_child[node] + static_cast<std::size_t>(nearest - distances.begin());
  }
  return word_of[node];
}

WordVector VocabularyTree::WordsOf(std::span<const Descriptor> descriptors) const {
  WordVector result;
  if (empty()) return result;
  std::vector<std::uint32_t> words;
  words.reserve(descriptors.size());
  for (const Descriptor& d : descriptors) words.push_back(WordOf(d));
  std::sort(words.begin(), words.end());
  double sum = 0.0;
  for (std::size_t first = 0, last = 0; first < words.size(); first = last) {
    while (last < words.size() && words[last] == words[first]) ++last;
    const double weight = static_cast<double>(last - first) * idf[words[first]];
    if (weight <= 0) continue;
    result.push_back({words[first], static_cast<float>(weight)});
    sum += weight;
  }
  for (WeightedWord& w : result) w.weight = static_cast<float>(w.weight / sum);
  return result;
}

}  // namespace alula::stack::slam
