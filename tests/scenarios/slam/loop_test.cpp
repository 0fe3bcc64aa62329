#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "scenarios/slam/train_vocabulary.h"
#include "stack/slam/keyframe_database.h"
#include "stack/slam/loop_filter.h"
#include "tests/scenarios/slam/photographer.h"

namespace alula::scenarios::slam::test {
namespace {

using stack::slam::KeyframeId;

constexpr int kLap = 24;        // keyframes a turn: 15° each
constexpr int kNeighbours = 4;  // keyframes that overlap: 60°

/// What a mapper would have of each keyframe: those before and after it, as long as it stood in one place.
std::vector<KeyframeId> NeighboursOf(int id) {
  std::vector<KeyframeId> around;
  for (int other = id - kNeighbours; other <= id + kNeighbours; ++other) {
    if (other >= 0 && other != id && other / kLap == id / kLap) around.push_back(static_cast<KeyframeId>(other));
  }
  return around;
}

struct Outcome {
  int found = 0;    // keyframes of the third lap whose loop geometry confirmed
  int first = -1;   // keyframes of the third lap until the first
  int wrong = 0;    // confirmed with a wrong pose
  int refused = 0;  // hypotheses that geometry refused
};

/// Turns once at a first place, once at a second, and once more near the first: the whole way from picture to relative
/// pose.
Outcome ThreeLaps(const std::string& world, std::uint64_t seed) {
  const stack::slam::Vocabulary vocabulary = stack::slam::LoadVocabulary(stack::slam::VocabularyPath());
  Photographer photographer(world, seed);
  const auto stations = gallery::RandomViewpoints(photographer.world(), 2, seed);
  std::vector<Keyframe> keyframes;
  stack::slam::KeyframeDatabase database;
  stack::slam::LoopFilter filter({});
  Outcome outcome;
  for (int id = 0; id < 3 * kLap; ++id) {
    const base::Transform& station = stations[id / kLap == 1 ? 1 : 0];
    const base::Transform turned{base::Exp(base::Vec3(0, 2 * std::numbers::pi * (id + 0.3 * (id / kLap)) / kLap, 0)),
                                 base::Vec3::Zero()};
    keyframes.push_back(photographer.Take(photographer.Near(station * turned, 0.15, 4.0)));
    const Keyframe& now = keyframes.back();
    const auto words = vocabulary.WordsOf(now.view);
    const std::vector<KeyframeId> around = NeighboursOf(id);
    filter.Update(database.Query(words, around));
    if (const auto loop = filter.Loop()) {
      const Keyframe& then = keyframes[loop->id];
      const auto pose = stack::slam::EstimateRelativePose(then.view, now.view, {}, static_cast<std::uint64_t>(id));
      const Error error = ErrorOf(pose, then, now);
      const bool right = error.metres < 0.2 && error.degrees < 3.0;
      if (!pose.accepted) {
        ++outcome.refused;
      } else if (!right) {
        ++outcome.wrong;
      } else if (id >= 2 * kLap) {
        ++outcome.found;
        if (outcome.first < 0) outcome.first = id - 2 * kLap;
      }
    }
    database.Add(static_cast<KeyframeId>(id), words);
    if (const int old = id - kNeighbours - 1; old >= 0) filter.Add(static_cast<KeyframeId>(old), NeighboursOf(old));
  }
  return outcome;
}

TEST(LoopsOfRenderedWorlds, AreFoundWithinAFewKeyframesAndNoneFalsely) {
  int wrong = 0, found = 0, late = 0, runs = 0;
  for (const char* world : {"machine_hall", "vicon_room", "forest", "courtyard"}) {
    for (const std::uint64_t seed : {4ULL, 11ULL}) {
      const Outcome o = ThreeLaps(world, seed);
      std::printf("%-13s seed %d: first loop after %d keyframes, %d of %d confirmed, %d refused, %d wrong\n", world,
                  static_cast<int>(seed), o.first, o.found, kLap, o.refused, o.wrong);
      wrong += o.wrong;
      found += o.found;
      late += o.first < 0 || o.first > 6;
      ++runs;
    }
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(found, runs * kLap * 6 / 10);
  EXPECT_LE(late, 1);
}

}  // namespace
}  // namespace alula::scenarios::slam::test
