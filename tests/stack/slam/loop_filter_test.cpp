#include "stack/slam/loop_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

namespace alula::stack::slam {
namespace {

/// A chain of keyframes, each the neighbour of the one before.
LoopFilter Chain(int count, const LoopFilterConfig& config = {}) {
  LoopFilter filter(config);
  for (int i = 0; i < count; ++i) {
    const std::vector<KeyframeId> before{static_cast<KeyframeId>(i - 1)};
    filter.Add(static_cast<KeyframeId>(i), i > 0 ? std::span<const KeyframeId>(before) : std::span<const KeyframeId>());
  }
  return filter;
}

std::vector<PlaceCandidate> Noise(int count, base::RandomStream& random) {
  std::vector<PlaceCandidate> scores;
  for (int i = 0; i < count; ++i) scores.push_back({static_cast<KeyframeId>(i), 0.05 + 0.01 * random.Uniform()});
  return scores;
}

double Sum(const LoopFilter& filter) {
  double sum = filter.new_place();
  for (const LoopHypothesis& h : filter.Hypotheses()) sum += h.probability;
  return sum;
}

TEST(LoopFilter, StaysWithANewPlaceOnNoise) {
  base::RandomStream random(1, "test/loops");
  LoopFilter filter = Chain(50);
  for (int step = 0; step < 200; ++step) {
    filter.Update(Noise(50, random));
    EXPECT_FALSE(filter.Loop()) << step;
    EXPECT_NEAR(Sum(filter), 1.0, 1e-12);
  }
  EXPECT_GT(filter.new_place(), 0.8);
}

TEST(LoopFilter, BelievesAPlaceThatIsSeenAgainAndAgain) {
  base::RandomStream random(2, "test/loops");
  LoopFilter filter = Chain(50);
  int first = -1;
  for (int step = 0; step < 12; ++step) {
    auto scores = Noise(50, random);
    scores[static_cast<std::size_t>(20 + step)].score = 0.2;  // flying along the chain again
    filter.Update(scores);
    if (const auto loop = filter.Loop(); loop && first < 0) {
      first = step;
      EXPECT_LE(std::abs(static_cast<double>(loop->id) - (20 + step)), 1.0);
    }
  }
  EXPECT_GE(first, 1);  // one picture is not enough
  EXPECT_LE(first, 6);
}

TEST(LoopFilter, ForgetsAPlaceThatIsSeenOnce) {
  base::RandomStream random(3, "test/loops");
  LoopFilter filter = Chain(50);
  for (int step = 0; step < 40; ++step) {
    auto scores = Noise(50, random);
    if (step % 10 == 5) scores[random.Index(50)].score = 0.12;  // look-alikes, each time elsewhere
    filter.Update(scores);
    EXPECT_FALSE(filter.Loop()) << step;
  }
}

/// The filter's equations over a full matrix of transitions.
TEST(LoopFilter, AgreesWithTheFullMatrix) {
  base::RandomStream random(4, "test/loops");
  constexpr int kCount = 12;
  const LoopFilterConfig config{.stay_new = 0.8, .stay_known = 0.7};
  LoopFilter filter = Chain(kCount, config);
  std::vector<double> p(kCount + 1, 0.0);  // the last: new
  p[kCount] = 1.0;
  for (int step = 0; step < 25; ++step) {
    auto scores = Noise(kCount, random);
    scores[random.Index(kCount)].score = random.Uniform(0.05, 0.4);
    std::vector<double> next(kCount + 1, 0.0);
    for (int from = 0; from <= kCount; ++from) {
      for (int to = 0; to <= kCount; ++to) {
        double chance = 0.0;
        if (from == kCount) {
          chance = to == kCount ? config.stay_new : (1 - config.stay_new) / kCount;
        } else if (to == kCount) {
          chance = 1 - config.stay_known;
        } else if (std::abs(from - to) <= 1) {
          chance = config.stay_known / (from == 0 || from == kCount - 1 ? 2 : 3);
        }
        next[static_cast<std::size_t>(to)] += chance * p[static_cast<std::size_t>(from)];
      }
    }
    std::vector<double> sorted, deviations;
    for (const auto& s : scores) sorted.push_back(s.score);
    std::sort(sorted.begin(), sorted.end());
    const double middle = sorted[kCount / 2];
    for (const auto& s : scores) deviations.push_back(std::abs(s.score - middle));
    std::sort(deviations.begin(), deviations.end());
    const double sigma = std::max(1.4826 * deviations[kCount / 2], 0.01);
    for (int i = 0; i < kCount; ++i) {
      const double own = scores[static_cast<std::size_t>(i)].score;
      double best = own;
      for (int k = std::max(0, i - 1); k <= std::min(kCount - 1, i + 1); ++k) {
        best = std::max(best, scores[static_cast<std::size_t>(k)].score);
      }
      const double evidence = std::exp((0.5 * (own + best) - middle) / sigma - 2.5);
      next[static_cast<std::size_t>(i)] *= std::max(1.0 / 100.0, std::min(100.0, evidence));
    }
    double sum = 0.0;
    for (const double value : next) sum += value;
    for (double& value : next) value /= sum;
    p = next;
    filter.Update(scores);
    for (const LoopHypothesis& h : filter.Hypotheses()) {
      EXPECT_NEAR(h.probability, p[h.id], 1e-9) << step << " " << h.id;
    }
    EXPECT_NEAR(filter.new_place(), p[kCount], 1e-9);
  }
}

TEST(LoopFilter, LosesNothingWhenAKeyframeGoes) {
  base::RandomStream random(5, "test/loops");
  LoopFilter filter = Chain(10);
  filter.Update(Noise(10, random));
  filter.Remove(4);
  filter.Remove(4);
  EXPECT_EQ(filter.Hypotheses().size(), 9U);
  EXPECT_NEAR(Sum(filter), 1.0, 1e-12);
  filter.Update(Noise(10, random));  // one score is of a keyframe that is gone
  EXPECT_NEAR(Sum(filter), 1.0, 1e-12);
  LoopFilter empty({});
  empty.Update(Noise(3, random));
  EXPECT_FALSE(empty.Loop());
  EXPECT_EQ(empty.new_place(), 1.0);
}

}  // namespace
}  // namespace alula::stack::slam
