#include "stack/slam/keyframe_database.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/error.h"
#include "base/random.h"

namespace alula::stack::slam {
namespace {

WordVector RandomWords(base::RandomStream& random, int count) {
  WordVector words;
  double sum = 0.0;
  for (std::uint32_t w = 0; w < 80; ++w) {
    if (static_cast<int>(random.Index(80)) >= count) continue;
    words.push_back({w, static_cast<float>(random.Uniform(0.1, 1.0))});
    sum += words.back().weight;
  }
  for (WeightedWord& w : words) w.weight = static_cast<float>(w.weight / sum);
  return words;
}

BagOfWords RandomBag(base::RandomStream& random) {
  return {RandomWords(random, 12), RandomWords(random, 4), 60 + static_cast<int>(random.Index(40)),
          10 + static_cast<int>(random.Index(20))};
}

TEST(KeyframeDatabase, AnswersAsBruteForceDoes) {
  base::RandomStream random(1, "test/database");
  KeyframeDatabase database;
  std::vector<std::pair<KeyframeId, BagOfWords>> all;
  for (KeyframeId id = 0; id < 60; ++id) {
    all.emplace_back(1000 - 7 * id, RandomBag(random));
    database.Add(all.back().first, all.back().second);
  }
  for (int i = 0; i < 20; ++i) {  // some go, others come into their slots
    const std::size_t k = random.Index(all.size());
    database.Remove(all[k].first);
    all[k] = {2000 + static_cast<KeyframeId>(i), RandomBag(random)};
    database.Add(all[k].first, all[k].second);
  }
  EXPECT_EQ(database.size(), all.size());
  for (int i = 0; i < 30; ++i) {
    const BagOfWords view = RandomBag(random);
    const std::vector<KeyframeId> excluded{all[3].first, all[9].first, 99999};
    std::map<KeyframeId, double> expected;
    for (const auto& [id, words] : all) {
      const double score = Likeness(view, words);
      if (score > 0 && std::find(excluded.begin(), excluded.end(), id) == excluded.end()) expected[id] = score;
    }
    const auto found = database.Query(view, excluded);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k].score, expected.at(found[k].id), 1e-6);
      EXPECT_LE(found[k].score, found[k > 0 ? k - 1 : 0].score);
    }
  }
}

TEST(KeyframeDatabase, KnowsItsKeyframes) {
  base::RandomStream random(2, "test/database");
  KeyframeDatabase database;
  const BagOfWords bag = RandomBag(random);
  EXPECT_TRUE(database.Query(bag, {}).empty());
  database.Add(5, bag);
  EXPECT_THROW(database.Add(5, bag), base::FaultError);
  ASSERT_NE(database.Find(5), nullptr);
  EXPECT_EQ(database.Find(5)->points, bag.points);
  EXPECT_NEAR(database.Query(bag, {}).at(0).score, 1.0, 1e-6);
  database.Remove(5);
  database.Remove(5);
  EXPECT_EQ(database.Find(5), nullptr);
  EXPECT_EQ(database.size(), 0U);
  EXPECT_TRUE(database.Query(bag, {}).empty());
  EXPECT_TRUE(database.Query({}, {}).empty());
}

TEST(Normalised, DividesByWhatTheNeighbourReaches) {
  const std::vector<PlaceCandidate> candidates{{1, 0.3}, {2, 0.1}};
  const auto scaled = Normalised(candidates, 0.4);
  EXPECT_DOUBLE_EQ(scaled[0].score, 0.75);
  EXPECT_DOUBLE_EQ(scaled[1].score, 0.25);
  EXPECT_TRUE(Normalised(candidates, 0.001).empty());  // a view that does not even know its neighbour
}

TEST(Grouped, OnePlaceCountsOnce) {
  // 10–14 see one place, each its neighbours; 30 stands alone with a better score than each of them.
  const std::vector<PlaceCandidate> candidates{{30, 0.30}, {12, 0.25}, {11, 0.20}, {13, 0.18}, {50, 0.02}};
  const auto neighbours = [](KeyframeId id) -> std::vector<KeyframeId> {
    if (id < 10 || id > 14) return {};
    return {id - 1, id + 1};
  };
  const auto groups = Grouped(candidates, neighbours);
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups[0].id, 12U);
  EXPECT_NEAR(groups[0].score, 0.63, 1e-12);
  EXPECT_EQ(groups[1].id, 30U);
  EXPECT_EQ(groups[2].id, 50U);
}

}  // namespace
}  // namespace alula::stack::slam
