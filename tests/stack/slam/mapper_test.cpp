#include "stack/slam/mapper.h"

#include <gtest/gtest.h>

#include <numbers>

#include "base/random.h"

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
  Flown flown{Mapper({Camera(), Camera(), *StereoEyes().X_LR}, config), {}};
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

}  // namespace
}  // namespace alula::stack::slam
