#include "stack/slam/vocabulary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/error.h"
#include "base/random.h"

namespace alula::stack::slam {
namespace {

using features::Descriptor;

Descriptor Random(base::RandomStream& random) { return {random.Bits(), random.Bits(), random.Bits(), random.Bits()}; }
Descriptor Worn(Descriptor d, int bits, base::RandomStream& random) {
  for (int i = 0; i < bits; ++i) d[random.Index(4)] ^= 1ULL << random.Index(64);
  return d;
}

/// Images of a world of `kinds` things, each image showing some of them, worn by `bits`.
std::vector<std::vector<Descriptor>> Images(int count, int kinds, int bits, std::uint64_t seed) {
  base::RandomStream random(seed, "test/images"), things(1, "test/things");
  std::vector<Descriptor> thing(static_cast<std::size_t>(kinds));
  for (Descriptor& d : thing) d = Random(things);
  std::vector<std::vector<Descriptor>> images(static_cast<std::size_t>(count));
  for (auto& image : images) {
    for (int i = 0; i < 60; ++i) image.push_back(Worn(thing[random.Index(thing.size())], bits, random));
  }
  return images;
}

PlaceView ViewOf(const std::vector<Descriptor>& points, const std::vector<Descriptor>& lines = {}) {
  PlaceView view;
  for (const Descriptor& d : points) view.points.push_back({.descriptor = d});
  for (const Descriptor& d : lines) view.lines.push_back({.descriptor = d});
  return view;
}

TEST(VocabularyTree, WordsOfOneThingAreMostlyOneWord) {
  const VocabularyTree tree = GrowTree(Images(40, 50, 20, 2), {.branching = 5, .levels = 4}, 1, "test");
  EXPECT_GE(tree.words(), 50U);
  base::RandomStream things(1, "test/things"), random(8, "test/worn");
  std::set<std::uint32_t> words;
  int same = 0;
  for (int i = 0; i < 50; ++i) {
    const Descriptor thing = Random(things);
    const std::uint32_t word = tree.WordOf(thing);
    words.insert(word);
    for (int k = 0; k < 10; ++k) same += tree.WordOf(Worn(thing, 12, random)) == word;
  }
  EXPECT_GE(words.size(), 48U);  // different things have different words
  EXPECT_GE(same, 400);          // of 500
}

/// The nearest of all leaves, without the tree's way down.
std::uint32_t NearestLeaf(const VocabularyTree& tree, const Descriptor& d) {
  int best = 999;
  std::uint32_t word = 0;
  for (std::size_t n = 0; n < tree.children.size(); ++n) {
    if (tree.children[n] > 0) continue;
    const int distance = features::HammingDistance(tree.centres[n], d);
    if (distance < best) {
      best = distance;
      word = tree.word_of[n];
    }
  }
  return word;
}

TEST(VocabularyTree, FindsTheLeafThatBruteForceFinds) {
  const auto images = Images(40, 50, 10, 3);
  const VocabularyTree tree = GrowTree(images, {.branching = 8, .levels = 3}, 1, "test");
  int same = 0, all = 0;
  for (const auto& image : images) {
    for (const Descriptor& d : image) {
      ++all;
      same += tree.WordOf(d) == NearestLeaf(tree, d);
    }
  }
  EXPECT_GE(same, all * 9 / 10);  // a greedy way down may miss one that lies beyond a boundary
}

TEST(VocabularyTree, OneLevelIsPlainKMedians) {
  // With one level the nearest child is the nearest leaf: brute force must agree on all.
  const auto images = Images(20, 12, 25, 4);
  const VocabularyTree tree = GrowTree(images, {.branching = 12, .levels = 1}, 1, "test");
  EXPECT_EQ(tree.words(), tree.children[0]);
  for (const Descriptor& d : images[0]) EXPECT_EQ(tree.WordOf(d), NearestLeaf(tree, d));
}

TEST(VocabularyTree, WeighsRareWordsMore) {
  // Thing 0 is in all images, thing 1 in one of four.
  base::RandomStream random(5, "test/idf");
  const Descriptor often = Random(random), rare = Random(random), third = Random(random);
  std::vector<std::vector<Descriptor>> images(8);
  for (std::size_t i = 0; i < images.size(); ++i) {
    for (int k = 0; k < 10; ++k) {
      images[i].push_back(often);
      images[i].push_back(i % 4 == 0 ? rare : third);
    }
  }
  const VocabularyTree tree = GrowTree(images, {.branching = 3, .levels = 1}, 1, "test");
  ASSERT_EQ(tree.words(), 3U);
  EXPECT_FLOAT_EQ(tree.idf[tree.WordOf(often)], 0.0F);
  EXPECT_FLOAT_EQ(tree.idf[tree.WordOf(rare)], static_cast<float>(std::log(4.0)));
  const WordVector words = tree.WordsOf(std::vector<Descriptor>{rare, rare, third, often});
  ASSERT_EQ(words.size(), 2U);  // what is everywhere says nothing
  const double weight_rare = 2 * std::log(4.0), weight_third = std::log(8.0 / 6.0);
  for (const WeightedWord& w : words) {
    const double expected = (w.word == tree.WordOf(rare) ? weight_rare : weight_third) / (weight_rare + weight_third);
    EXPECT_NEAR(w.weight, expected, 1e-6);
  }
}

TEST(Likeness, IsOneMinusHalfTheL1Distance) {
  base::RandomStream random(6, "test/l1");
  for (int round = 0; round < 50; ++round) {
    std::array<std::vector<double>, 2> dense{std::vector<double>(40, 0.0), std::vector<double>(40, 0.0)};
    std::array<WordVector, 2> sparse;
    for (std::size_t s = 0; s < 2; ++s) {
      double sum = 0.0;
      for (double& w : dense[s]) sum += w = random.Uniform() < 0.4 ? random.Uniform() + 0.01 : 0.0;
      for (std::size_t i = 0; i < dense[s].size(); ++i) {
        dense[s][i] /= sum;
        if (dense[s][i] > 0) sparse[s].push_back({static_cast<std::uint32_t>(i), static_cast<float>(dense[s][i])});
      }
    }
    double l1 = 0.0;
    for (std::size_t i = 0; i < 40; ++i) l1 += std::abs(dense[0][i] - dense[1][i]);
    EXPECT_NEAR(Likeness(sparse[0], sparse[1]), 1 - 0.5 * l1, 1e-6);
    EXPECT_NEAR(Likeness(sparse[0], sparse[0]), 1.0, 1e-6);
  }
}

TEST(Likeness, WeighsPointsAndLinesByTheirNumbers) {
  const auto images = Images(12, 30, 10, 7);
  const Vocabulary vocabulary =
      TrainVocabulary({images, Images(12, 10, 10, 8)}, {.branching = 6, .levels = 2}, {.branching = 4, .levels = 2}, 1);
  const std::vector<Descriptor> few(images[1].begin(), images[1].begin() + 20);
  const BagOfWords a = vocabulary.WordsOf(ViewOf(images[0], few)), b = vocabulary.WordsOf(ViewOf(images[2], few));
  const double s_p = Likeness(a.points, b.points), s_l = Likeness(a.lines, b.lines);
  EXPECT_NEAR(s_l, 1.0, 1e-6);
  EXPECT_NEAR(Likeness(a, b), (60 * s_p + 20 * s_l) / 80, 1e-9);
  // Without a tree of lines they have no say.
  const Vocabulary points_only{vocabulary.points, {}};
  EXPECT_NEAR(Likeness(points_only.WordsOf(ViewOf(images[0], few)), points_only.WordsOf(ViewOf(images[2], few))), s_p,
              1e-9);
  EXPECT_EQ(Likeness(BagOfWords{}, a), 0.0);
}

TEST(Vocabulary, GoesToBytesAndBackAndIsTheSameEveryTime) {
  const TrainingSet set{Images(10, 30, 10, 9), Images(10, 8, 10, 10)};
  const Vocabulary one = TrainVocabulary(set, {.branching = 5, .levels = 3}, {.branching = 3, .levels = 2}, 4);
  const std::vector<std::uint8_t> bytes = ToBytes(one);
  EXPECT_EQ(bytes, ToBytes(TrainVocabulary(set, {.branching = 5, .levels = 3}, {.branching = 3, .levels = 2}, 4)));
  EXPECT_NE(bytes, ToBytes(TrainVocabulary(set, {.branching = 5, .levels = 3}, {.branching = 3, .levels = 2}, 5)));
  const Vocabulary back = VocabularyFromBytes(bytes, "test");
  EXPECT_EQ(ToBytes(back), bytes);
  for (const Descriptor& d : set.points[0]) EXPECT_EQ(back.points.WordOf(d), one.points.WordOf(d));
}

TEST(Vocabulary, RefusesBrokenBytes) {
  const Vocabulary good = TrainVocabulary({Images(10, 30, 10, 9), {}}, {.branching = 5, .levels = 3}, {}, 4);
  const std::vector<std::uint8_t> bytes = ToBytes(good);
  EXPECT_THROW(VocabularyFromBytes({}, "test"), base::InputError);
  for (std::size_t length = 0; length < bytes.size(); length += 97) {
    EXPECT_THROW(VocabularyFromBytes(std::span(bytes).first(length), "test"), base::InputError) << length;
  }
  std::vector<std::uint8_t> longer = bytes;
  longer.push_back(0);
  EXPECT_THROW(VocabularyFromBytes(longer, "test"), base::InputError);
  base::RandomStream random(11, "test/broken");
  for (int i = 0; i < 300; ++i) {  // anything may be in it, but nothing may go wrong with what is taken
    std::vector<std::uint8_t> broken = bytes;
    const std::size_t counts = 16 + good.points.children.size();
    broken[8 + random.Index(counts)] = static_cast<std::uint8_t>(random.Index(256));
    try {
      const Vocabulary v = VocabularyFromBytes(broken, "test");
      if (v.points.empty()) continue;
      EXPECT_LT(v.points.WordOf(Random(random)), v.points.words());
    } catch (const base::InputError&) {
    }
  }
  EXPECT_THROW(LoadVocabulary("/nowhere/vocabulary.bin"), base::InputError);
}

TEST(Vocabulary, OfNothingIsEmpty) {
  const Vocabulary nothing = TrainVocabulary({}, {}, {}, 1);
  EXPECT_TRUE(nothing.points.empty());
  const Vocabulary back = VocabularyFromBytes(ToBytes(nothing), "test");
  EXPECT_TRUE(back.WordsOf(ViewOf(Images(1, 5, 3, 1)[0])).points.empty());
}

}  // namespace
}  // namespace alula::stack::slam
