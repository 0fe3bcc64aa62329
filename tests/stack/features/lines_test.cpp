#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "stack/features/line_segments.h"
#include "stack/features/line_stereo.h"
#include "stack/features/line_tracks.h"

namespace alula::stack::features {
namespace {

using base::Vec2;
using base::Vec3;

constexpr int kWidth = 640, kHeight = 480;

Image ImageOf(const std::vector<double>& grey) {
  Image image;
  image.width = image.stride = kWidth;
  image.height = kHeight;
  auto bytes = std::make_shared<std::vector<std::uint8_t>>(grey.size());
  for (std::size_t i = 0; i < grey.size(); ++i)
    (*bytes)[i] = static_cast<std::uint8_t>(std::clamp(std::lround(grey[i]), 0L, 255L));
  image.bytes = std::move(bytes);
  return image;
}

/// A bright convex polygon on grey, its edges blurred over a pixel, with noise. Corners clockwise as it is looked at.
Image Polygon(const std::vector<Vec2>& corners, double noise, std::uint64_t seed) {
  base::RandomStream random(seed, "test/lines");
  std::vector<double> grey(static_cast<std::size_t>(kWidth) * kHeight);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      double inside = 1e9;
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vec2 &a = corners[i], along = (corners[(i + 1) % corners.size()] - a).normalized();
        const Vec2 d = Vec2(u, v) - a;
        inside = std::min(inside, along.x() * d.y() - along.y() * d.x());
      }
      const double share = std::clamp(0.5 + inside, 0.0, 1.0);
      grey[static_cast<std::size_t>(v) * kWidth + static_cast<std::size_t>(u)] =
          90 + 70 * share + noise * random.Gaussian();
    }
  }
  return ImageOf(grey);
}

std::vector<Vec2> Square(double angle) {
  std::vector<Vec2> corners;
  for (int i = 0; i < 4; ++i) {
    const double a = angle + std::numbers::pi / 2 * i;
    corners.push_back(Vec2(320, 240) + 180 * Vec2(std::cos(a), std::sin(a)));
  }
  return corners;
}

class Detector : public testing::TestWithParam<std::pair<LineDetector, bool>> {};

TEST_P(Detector, FindsTheSidesOfASquareWhereTheyAre) {
  LineConfig config;
  std::tie(config.detector, config.half) = GetParam();
  for (int k = 0; k < 12; ++k) {
    const std::vector<Vec2> corners = Square(0.05 + 0.13 * k);
    LineCounts counts;
    const std::vector<LineSegment> lines =
        DetectLines(Polygon(corners, 1.5, static_cast<std::uint64_t>(k)), config, &counts);
    ASSERT_EQ(lines.size(), 4U) << k;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 &a = corners[i], &b = corners[(i + 1) % 4];
      const Vec2 along = (b - a).normalized();
      const auto across = [&](const Vec2& p) { return std::abs(along.x() * (p - a).y() - along.y() * (p - a).x()); };
      const auto best = std::min_element(lines.begin(), lines.end(), [&](const LineSegment& p, const LineSegment& q) {
        return across(p.a) + across(p.b) < across(q.a) + across(q.b);
      });
      EXPECT_LT(across(best->a), 0.5) << k;
      EXPECT_LT(across(best->b), 0.5) << k;
      EXPECT_GT(best->Along().dot(along), 0.999);  // the bright side lies to the right
      EXPECT_LT((best->a - a).norm(), 8.0);
      EXPECT_LT((best->b - b).norm(), 8.0);
    }
    EXPECT_GE(counts.found, 4);
    EXPECT_EQ(counts.kept, 4);
  }
}
INSTANTIATE_TEST_SUITE_P(Both, Detector,
                         testing::Values(std::pair{LineDetector::kEdLines, true},
                                         std::pair{LineDetector::kEdLines, false}, std::pair{LineDetector::kLsd, true},
                                         std::pair{LineDetector::kLsd, false}));

TEST(Lines, NoiseHasNone) {
  base::RandomStream random(3, "test/lines");
  std::vector<double> grey(static_cast<std::size_t>(kWidth) * kHeight);
  for (double& g : grey) g = 120 + 12 * random.Gaussian();
  LineConfig config;
  config.reduce = false;
  config.half = false;
  EXPECT_LE(DetectLines(ImageOf(grey), config).size(), 2U);  // one false alarm an image is what is asked for
}

TEST(Lines, PiecesOfOneEdgeBecomeOne) {
  LineConfig config;
  const std::vector<LineSegment> pieces = {{{100, 100}, {180, 101}, 10}, {{190, 101}, {260, 102}, 10},
                                           {{100, 300}, {200, 300}, 10},   // another edge
                                           {{210, 310}, {300, 310}, 10},   // beside it
                                           {{260, 99}, {200, 98}, 10},     // the other way round
                                           {{400, 100}, {410, 100}, 10}};  // short
  const std::vector<LineSegment> lines = ReduceLines(pieces, kWidth, kHeight, config);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_NEAR(lines[0].Length(), 160.0, 0.5);
  EXPECT_NEAR(lines[0].a.y(), 100.0, 0.5);
  EXPECT_NEAR(lines[0].b.x(), 260.0, 0.5);
}

TEST(Lines, RefuseColour) {
  Image image = ImageOf(std::vector<double>(static_cast<std::size_t>(kWidth) * kHeight, 1.0));
  image.format = PixelFormat::kRgb8;
  EXPECT_THROW(DetectLines(image, {}), base::InputError);
}

TEST(LineStereo, EndsLieInSpaceWhereTheSquareIs) {
  // A square 3 m away, seen by two eyes 0.11 m apart of which one is turned a little.
  const CameraIntrinsics camera{kWidth, kHeight, 420, 420, 320, 240, {}, DistortionModel::kRadialTangential};
  const StereoRig rig{camera, camera, {base::Exp(Vec3(0.004, -0.006, 0.005)), Vec3(0.11, 0.001, -0.002)}};
  const base::Transform X_RL = rig.X_LR.Inverse();
  std::vector<Vec3> corners;
  std::vector<Vec2> left, right;
  for (const Vec2& c : Square(0.15)) {
    const Vec3 p_L =
        3.0 * Vec3((c.x() - 320) / 420, (c.y() - 240) / 420, 1.0) + Vec3(0.1, 0, 0.3 * (c.x() - 320) / 180);
    corners.push_back(p_L);
    left.push_back(Project(camera, p_L));
    right.push_back(Project(camera, X_RL * p_L));
  }
  const Image image_l = Polygon(left, 1.0, 1), image_r = Polygon(right, 1.0, 2);
  const std::vector<LineSegment> lines_l = DetectLines(image_l, {}), lines_r = DetectLines(image_r, {});
  const std::vector<StereoLine> matches = MatchLines(rig, image_l, image_r, lines_l, lines_r, {});
  ASSERT_EQ(matches.size(), 4U);
  for (const StereoLine& match : matches) {
    double nearest = 1e9;
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3 &a = corners[i], along = (corners[(i + 1) % 4] - a).normalized();
      double worst = 0.0;
      for (const Vec3& end : match.ends_L) worst = std::max(worst, along.cross(end - a).norm());
      nearest = std::min(nearest, worst);
    }
    EXPECT_LT(nearest, 0.12);  // half a pixel of disparity at 3 m is 0.1 m
  }
}

TEST(LineTracks, ExpectedWhereItIsSeenAndCutOffAtTheEdge) {
  const CameraIntrinsics camera{kWidth, kHeight, 420, 420, 320, 240, {}, DistortionModel::kRadialTangential};
  const auto whole = ExpectSegment(camera, Vec3(-1, 0, 4), Vec3(1, 0.5, 4));
  ASSERT_TRUE(whole);
  EXPECT_LT((whole->a - Vec2(215, 240)).norm(), 1e-9);
  EXPECT_LT((whole->b - Vec2(425, 292.5)).norm(), 1e-9);
  const auto cut = ExpectSegment(camera, Vec3(0, 0, 4), Vec3(40, 0, 4));
  ASSERT_TRUE(cut);
  EXPECT_LT(cut->b.x(), kWidth);
  EXPECT_FALSE(ExpectSegment(camera, Vec3(0, 0, -1), Vec3(1, 0, -2)));
}

TEST(LineTracks, FollowsTheNearestOfTheSameSense) {
  const std::vector<ExpectedLine> expected = {{7, {{100, 100}, {200, 100}, 0}}, {9, {{100, 105}, {200, 105}, 0}}};
  const std::vector<LineSegment> segments = {{{105, 104.5}, {190, 104.8}, 5},  // 9
                                             {{200, 100}, {100, 100}, 5},      // the other way round
                                             {{110, 101}, {150, 101}, 5},      // 7
                                             {{300, 100}, {400, 100}, 5}};     // farther on
  const auto followed = FollowLines(expected, segments, {});
  ASSERT_EQ(followed.size(), 2U);
  EXPECT_EQ(followed[0].id, 7U);
  EXPECT_EQ(followed[0].segment, 2);
  EXPECT_EQ(followed[1].segment, 0);
}

}  // namespace
}  // namespace alula::stack::features
