#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <string>

#include "base/random.h"
#include "stack/slam/vocabulary_tree.h"

namespace alula::stack::slam {
namespace {

using features::Descriptor;

/// Indices into the common list.
using Members = std::vector<std::uint32_t>;

/// The bits that most members have; where as many have a bit as not, it is 0.
Descriptor Median(const std::vector<Descriptor>& all, const Members& members) {
  std::array<std::uint32_t, 256> ones{};
  for (const std::uint32_t m : members) {
    for (std::size_t bit = 0; bit < ones.size(); ++bit)
      ones[bit] += static_cast<std::uint32_t>(all[m][bit / 64] >> (bit % 64) & 1U);
  }
  Descriptor median{};
  for (std::size_t bit = 0; bit < ones.size(); ++bit) {
    if (2 * ones[bit] > members.size()) median[bit / 64] |= 1ULL << (bit % 64);
  }
  return median;
}

/// First centres: one member at random, then each with a chance in proportion to its squared distance from those
/// chosen.
std::vector<Descriptor> Seeds(const std::vector<Descriptor>& all, const Members& members, int count,
                              base::RandomStream& random) {
  std::vector<Descriptor> seeds{all[members[random.Index(members.size())]]};
  std::vector<double> squared(members.size(), 1e9);
  while (static_cast<int>(seeds.size()) < count) {
    double sum = 0.0;
    for (std::size_t i = 0; i < members.size(); ++i) {
      const double d = features::HammingDistance(all[members[i]], seeds.back());
      squared[i] = std::min(squared[i], d * d);
      sum += squared[i];
    }
    if (sum <= 0) break;  // no other descriptor is left
    double at = random.Uniform() * sum;
    std::size_t chosen = 0;
    while (chosen + 1 < members.size() && (at -= squared[chosen]) >= 0) ++chosen;
    seeds.push_back(all[members[chosen]]);
  }
  return seeds;
}

struct Cluster {
  Descriptor centre{};
  Members members;
};

std::vector<Cluster> Assign(const std::vector<Descriptor>& all, const Members& members,
                            const std::vector<Descriptor>& centres) {
  std::vector<Cluster> clusters(centres.size());
  for (std::size_t c = 0; c < centres.size(); ++c) clusters[c].centre = centres[c];
  std::vector<std::uint16_t> distances(centres.size());
  for (const std::uint32_t m : members) {
    features::HammingDistances(all[m], centres, distances);
    const auto nearest = std::min_element(distances.begin(), distances.end()) - distances.begin();
    clusters[static_cast<std::size_t>(nearest)].members.push_back(m);
  }
  std::erase_if(clusters, [](const Cluster& c) { return c.members.empty(); });
  return clusters;
}

/// k-medians (Lloyd's steps) until no centre moves.
std::vector<Cluster> Split(const std::vector<Descriptor>& all, const Members& members, const TreeShape& shape,
                           base::RandomStream& random) {
  std::vector<Cluster> clusters = Assign(all, members, Seeds(all, members, shape.branching, random));
  for (int i = 0; i < shape.iterations; ++i) {
    std::vector<Descriptor> before, centres;
    for (const Cluster& c : clusters) {
      before.push_back(c.centre);
      centres.push_back(Median(all, c.members));
    }
    if (i > 0 && centres == before) break;
    clusters = Assign(all, members, centres);
  }
  return clusters;
}

/// ln(N / N_i) of each word over the images.
std::vector<float> InverseFrequencies(const VocabularyTree& tree, std::size_t words,
                                      const std::vector<std::vector<Descriptor>>& images) {
  std::vector<std::uint32_t> seen(words, 0), last(words, 0);
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (const Descriptor& d : images[i]) {
      const std::uint32_t word = tree.WordOf(d);
      if (last[word] == i + 1) continue;
      last[word] = static_cast<std::uint32_t>(i + 1);
      ++seen[word];
    }
  }
  std::vector<float> idf;
  for (const std::uint32_t n : seen) {
    const double count = std::max<std::uint32_t>(1, n);
    idf.push_back(static_cast<float>(std::log(static_cast<double>(images.size()) / count)));
  }
  return idf;
}

}  // namespace

VocabularyTree GrowTree(const std::vector<std::vector<Descriptor>>& images, const TreeShape& shape, std::uint64_t seed,
                        std::string_view name) {
  std::vector<Descriptor> all;
  for (const auto& image : images) all.insert(all.end(), image.begin(), image.end());
  VocabularyTree tree;
  if (all.empty()) return tree;
  struct Node {
    Descriptor centre{};
    Members members;
    int level = 0;
  };
  std::deque<Node> waiting(1);  // breadth first
  for (std::uint32_t i = 0; i < all.size(); ++i) waiting[0].members.push_back(i);
  for (; !waiting.empty(); waiting.pop_front()) {
    const Node& node = waiting.front();
    std::vector<Cluster> clusters;
    if (node.level < shape.levels && node.members.size() > static_cast<std::size_t>(2 * shape.branching)) {
      base::RandomStream random(seed, std::string(name) + "/" + std::to_string(tree.children.size()));
      clusters = Split(all, node.members, shape, random);
      if (clusters.size() < 2) clusters.clear();
    }
    tree.centres.push_back(node.centre);
    tree.children.push_back(static_cast<std::uint8_t>(clusters.size()));
    const int level = node.level + 1;
    for (Cluster& c : clusters) waiting.push_back({c.centre, std::move(c.members), level});
  }
  const auto words = static_cast<std::size_t>(std::count(tree.children.begin(), tree.children.end(), 0));
  tree.idf.assign(words, 0.0F);
  tree.Index();
  tree.idf = InverseFrequencies(tree, words, images);
  return tree;
}

}  // namespace alula::stack::slam
