#include "stack/slam/mapper.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"
#include "stack/slam/map_file.h"
#include "stack/slam/vocabulary.h"

namespace alula::stack::slam {
namespace {

using base::Time;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPixelNoise = 0.3;

CameraIntrinsics Camera() { return {752, 480, 458, 458, 376, 240, {}, DistortionModel::kRadialTangential}; }

Eyes StereoEyes() {
  Eyes eyes;
  eyes.X_BL = {base::ForwardCameraRotation(), Vec3(0.1, 0.05, 0)};
  eyes.X_LR = Transform{base::Quat::Identity(), Vec3(0.11, 0, 0)};
  return eyes;
}

/// A room's walls with points of random looks.
struct Room {
  struct Spot {
    Vec3 p_W;
    features::Descriptor descriptor{};
  };
  std::vector<Spot> spots;

  explicit Room(int count) {
    base::RandomStream random(1, "test/room");
    for (int i = 0; i < count; ++i) {
      const double angle = random.Uniform(0, 2 * std::numbers::pi);
      Spot spot{{6 * std::cos(angle), 6 * std::sin(angle), random.Uniform(-2, 3)}, {}};
      for (std::uint64_t& word : spot.descriptor) word = random.Bits();
      spots.push_back(spot);
    }
  }

  PlaceView SeenFrom(const Transform& X_WB, base::RandomStream& noise) const {
    const CameraIntrinsics camera = Camera();
    const Eyes eyes = StereoEyes();
    const Transform X_LW = (X_WB * eyes.X_BL).Inverse();
    PlaceView view;
    view.focal = 458;
    view.focal_baseline = 458 * 0.11;
    for (const Spot& spot : spots) {
      const Vec3 p_L = X_LW * spot.p_W;
      if (p_L.z() < 0.5) continue;
      const Vec2 exact = Project(camera, p_L);
      if (!Inside(camera, exact, 2)) continue;
      PlacePoint f;
      f.pixel = exact + kPixelNoise * Vec2(noise.Gaussian(), noise.Gaussian());
      f.normalised = Normalise(camera, f.pixel);
      const double disparity = 458 * 0.11 / p_L.z() + 0.2 * noise.Gaussian();
      f.p_C = 458 * 0.11 / disparity * f.normalised.homogeneous();
      f.descriptor = spot.descriptor;
      view.points.push_back(f);
    }
    return view;
  }
};

/// Round the room twice, looking outwards; the odometry drifts in position and heading.
Transform TruthAt(int i) {
  const double a = 2 * std::numbers::pi * i / 60;
  return {base::FromYaw(a), Vec3(1.5 * std::cos(a), 1.5 * std::sin(a), 0.2 * std::sin(2 * a))};
}
Transform DriftingAt(int i) {
  const Transform drift{base::FromYaw(0.0004 * i), Vec3(0.0012, -0.0008, 0.0005) * i};
  return drift * TruthAt(i);
}

struct Flown {
  Mapper mapper;
  std::vector<KeyframeReport> reports;
};
Flown FlyTwoRounds(const MapConfig& config) {
  const Room room(700);
  Flown flown{Mapper({Camera(), Camera(), *StereoEyes().X_LR}, config, nullptr), {}};
  base::RandomStream noise(2, "test/noise");
  for (int i = 0; i < 120; ++i) {
    KeyframeInput input;
    input.seq = static_cast<std::uint32_t>(i);
    input.stamp = Time{} + base::Milliseconds(300 * i);
    input.X_OB = DriftingAt(i);
    input.eyes = StereoEyes();
    input.view = room.SeenFrom(TruthAt(i), noise);
    for (int k = std::max(0, i - 5); k < i; ++k)
      input.window.push_back({Time{} + base::Milliseconds(300 * k), DriftingAt(k)});
    flown.reports.push_back(flown.mapper.Add(std::move(input)));
  }
  return flown;
}

TEST(Mapper, APlaceSeenAgainTakesTheDriftBack) {
  const Flown flown = FlyTwoRounds({});
  double odometry = 0.0, mapped = 0.0;
  for (int i = 61; i < 120; ++i) {
    const Vec3 truth = TruthAt(i).p;
    odometry = std::max(odometry, (DriftingAt(i).p - truth).norm());
    mapped = std::max(mapped, ((flown.reports[static_cast<std::size_t>(i)].X_MO * DriftingAt(i)).p - truth).norm());
  }
  EXPECT_GT(odometry, 0.18);
  EXPECT_LT(mapped, 0.04);
  int matched = 0;
  for (std::size_t i = 65; i < 120; ++i) matched += flown.reports[i].matched;
  EXPECT_GT(matched / 55, 60);  // of about 110 in view
}

TEST(Mapper, TheEndIsBetterThanTheWay) {
  Flown flown = FlyTwoRounds({});
  flown.mapper.Finish();
  double worst = 0.0;
  for (int i = 0; i < 120; ++i) worst = std::max(worst, (flown.mapper.PoseOf(i).p - TruthAt(i).p).norm());
  EXPECT_LT(worst, 0.03);
}

TEST(Mapper, KeepsAsManyKeyframesAsThePlaceNeeds) {
  const Flown flown = FlyTwoRounds({});
  int kept = 0;
  for (const auto& keyframe : flown.mapper.map().keyframes) kept += keyframe ? 1 : 0;
  EXPECT_LT(kept, 100);  // of 120
  for (int i = 0; i < 120; ++i) {
    EXPECT_LT((flown.mapper.PoseOf(i).p - TruthAt(i).p).norm(), 0.1) << i;  // dropped ones too have a place
  }
  // Every sight is known to both sides.
  const Map& map = flown.mapper.map();
  for (std::size_t l = 0; l < map.landmarks.size(); ++l) {
    if (!map.landmarks[l]) continue;
    ASSERT_FALSE(map.landmarks[l]->sights.empty());
    for (const Landmark::Sight& s : map.landmarks[l]->sights) {
      ASSERT_TRUE(map.keyframes[static_cast<std::size_t>(s.keyframe)]);
      EXPECT_EQ(map.keyframe(s.keyframe).landmarks[static_cast<std::size_t>(s.feature)], static_cast<int>(l));
    }
  }
}

TEST(Mapper, TheSameBitsTwice) {
  const Flown a = FlyTwoRounds({}), b = FlyTwoRounds({});
  for (std::size_t i = 0; i < a.reports.size(); ++i) {
    EXPECT_EQ(a.reports[i].X_MO.p, b.reports[i].X_MO.p);
    EXPECT_EQ(a.reports[i].matched, b.reports[i].matched);
  }
}

/// Keyframes as they come from an odometry, which may lose its way.
class Flight {
 public:
  explicit Flight(const MapConfig& config, Map known = {})
      : mapper({Camera(), Camera(), *StereoEyes().X_LR}, config, SharedVocabulary(), std::move(known)) {}

  /// `X_OW`: where the odometry has its origin by now; another one than before means that it has lost its way.
  KeyframeReport Take(const Room& room, const Transform& X_WB, const Transform& X_OW) {
    if ((X_OW.p - X_OW_.p).norm() > 0.0) window_.clear();
    X_OW_ = X_OW;
    KeyframeInput input;
    input.seq = static_cast<std::uint32_t>(taken_);
    input.stamp = Time{} + base::Milliseconds(300 * taken_++);
    input.X_OB = X_OW * X_WB;
    input.eyes = StereoEyes();
    input.view = room.SeenFrom(X_WB, noise_);
    input.window = window_;
    window_.push_back({input.stamp, input.X_OB});
    return mapper.Add(std::move(input));
  }

  Mapper mapper;

 private:
  base::RandomStream noise_{2, "test/noise"};
  Transform X_OW_;
  std::vector<estimation::KeyframePose> window_;
  int taken_ = 0;
};

TEST(Mapper, WhoHasLostTheWayIsFoundAgainByWhatItSees) {
  const Room room(700);
  Flight flight({});
  for (int i = 0; i < 60; ++i) flight.Take(room, TruthAt(i), {});
  const Transform X_OW{base::FromYaw(0.6), Vec3(3, -2, 0.4)};
  int joined_at = -1;
  for (int i = 0; i < 40; ++i) {
    const KeyframeReport report = flight.Take(room, TruthAt(20 + i), X_OW);
    if (report.joined && joined_at < 0) joined_at = i;
    const Transform X_MB = report.X_MO * X_OW * TruthAt(20 + i);
    if (joined_at < 0) {
      EXPECT_GT((X_MB.p - TruthAt(20 + i).p).norm(), 1.0);
    } else {
      EXPECT_LT((X_MB.p - TruthAt(20 + i).p).norm(), 0.02) << i;
    }
  }
  EXPECT_GE(joined_at, 1);  // one keyframe's word is not enough
  EXPECT_LE(joined_at, 6);
  for (int k = 0; k < 100; ++k) {
    const Vec3 truth = TruthAt(k < 60 ? k : k - 40).p;
    EXPECT_LT((flight.mapper.PoseOf(k).p - truth).norm(), 0.03) << k;
  }
}

TEST(Mapper, AMapFromBeforeIsGoneOnWith) {
  const Room room(700);
  Flight yesterday({});
  for (int i = 0; i < 60; ++i) yesterday.Take(room, TruthAt(i), {});
  Flight today({}, MapFromBytes(ToBytes(yesterday.mapper.map()), "test"));
  const Transform X_OW{base::FromYaw(-0.4), Vec3(1, 2, 0)};
  KeyframeReport last;
  for (int i = 0; i < 20; ++i) last = today.Take(room, TruthAt(30 + i), X_OW);
  EXPECT_LT(((last.X_MO * X_OW * TruthAt(49)).p - TruthAt(49).p).norm(), 0.02);
}

/// Half round a room, then half round another one next door that looks the same. How many loops it took that for.
int LoopsNextDoor(const MapConfig& config, Vec3& end) {
  const Room room(700);
  const Transform next_door{base::Quat::Identity(), Vec3(14, 0, 0)};
  Room other = room;
  for (Room::Spot& spot : other.spots) spot.p_W += next_door.p;
  Flight flight(config);
  int loops = 0;
  for (int i = 0; i < 40; ++i) flight.Take(room, TruthAt(i), {});
  for (int i = 0; i < 40; ++i) loops += flight.Take(other, next_door * TruthAt(i), {}).loop ? 1 : 0;
  end = flight.mapper.PoseOf(79).p - next_door * TruthAt(39).p;
  return loops;
}

TEST(Mapper, ARoomThatLooksTheSameIsNotTheSame) {
  Vec3 error;
  EXPECT_EQ(LoopsNextDoor({}, error), 0);
  EXPECT_LT(error.norm(), 0.1);
  MapConfig credulous;
  credulous.loop.drift_position = 20.0;
  EXPECT_GT(LoopsNextDoor(credulous, error), 0);  // so it is the odometry's word that refuses
}

TEST(SpreadLoop, TakesTheErrorBackAlongTheWay) {
  // Forty keyframes whose motions are a little off in heading and height, which the loop can tell; what it cannot tell,
  // such as a shift ahead at each step of a round, stays.
  const RelativeMotion off{0, 0, {base::FromYaw(0.002), Vec3(0, 0, 0.004)}, base::Vec6::Constant(0.01)};
  Map map;
  map.eyes = StereoEyes();
  map.anchors = {0};
  for (int i = 0; i <= 40; ++i) {
    auto keyframe = std::make_unique<Keyframe>();
    keyframe->id = i;
    keyframe->previous = i - 1;
    keyframe->X_MB = i == 0 ? TruthAt(0) : map.keyframe(i - 1).X_MB * TruthAt(i - 1).Inverse() * TruthAt(i) * off.X_FT;
    if (i > 0) {
      keyframe->from_previous = off;
      keyframe->from_previous->X_FT = TruthAt(i - 1).Inverse() * TruthAt(i) * off.X_FT;
    }
    PlacePoint point;
    point.scale = 1.0;
    keyframe->view.points.push_back(point);
    keyframe->landmarks.assign(1, -1);
    map.keyframes.push_back(std::move(keyframe));
  }
  const int landmark = AddLandmark(map, 40, 0, map.keyframe(40).X_MB * Vec3(2, 0, 0));
  double before = 0.0, after = 0.0;
  for (int i = 0; i <= 40; ++i) before = std::max(before, (map.keyframe(i).X_MB.p - TruthAt(i).p).norm());
  SpreadLoop(map, {0, 40, TruthAt(0).Inverse() * TruthAt(40)}, {});
  for (int i = 0; i <= 40; ++i) {
    after = std::max(after, (map.keyframe(i).X_MB.p - TruthAt(i).p).norm());
    EXPECT_LT((map.keyframe(i).X_MB.q.conjugate() * Vec3::UnitZ() - Vec3::UnitZ()).norm(), 1e-3);  // upright
  }
  EXPECT_GT(before, 0.15);
  EXPECT_LT(after, 0.25 * before);
  EXPECT_LT((map.landmark(landmark).p_M - map.keyframe(40).X_MB * Vec3(2, 0, 0)).norm(), 1e-9);
}

}  // namespace
}  // namespace alula::stack::slam
