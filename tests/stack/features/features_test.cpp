#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "base/random.h"
#include "stack/features/stereo_rig.h"
#include "stack/features/stereo_tracker.h"
#include "stack/features/translation_ransac.h"

namespace alula::stack::features::test {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;

CameraIntrinsics Pinhole() { return {640, 480, 381.0, 381.0, 319.5, 239.5, {}}; }

TEST(CameraModel, NormaliseInvertsDistortion) {
  CameraIntrinsics camera = Pinhole();
  camera.distortion = {-0.28, 0.07, 2e-4, 2e-5, 0.0};
  for (double v = 0; v < 480; v += 40) {
    for (double u = 0; u < 640; u += 40) {
      const Vec2 n = Normalise(camera, {u, v});
      EXPECT_LT((Project(camera, 3.0 * Vec3(n.homogeneous())) - Vec2(u, v)).norm(), 1e-8);
    }
  }
}

TEST(CameraModel, TriangulatesTheDepthOfAPoint) {
  const Transform X_LR{base::Exp(Vec3(0.01, -0.02, 0.015)), Vec3(0.11, 0.002, -0.001)};
  const Vec3 p_L(0.4, -0.3, 5.0), p_R = X_LR.Inverse() * p_L;
  EXPECT_NEAR(TriangulatedDepth(X_LR, p_L.head<2>() / p_L.z(), p_R.head<2>() / p_R.z()), 5.0, 1e-9);
}

TEST(TranslationRansac, FindsTheMotionAmongOutliers) {
  base::RandomStream random(3, "test/ransac");
  const Vec3 t(0.1, -0.05, 0.2);
  std::vector<TurnedPoint> points;
  for (int i = 0; i < 100; ++i) {
    const Vec3 p(random.Uniform(-4, 4), random.Uniform(-3, 3), random.Uniform(3, 12));
    const Vec3 moved = p + t;
    Vec2 seen = moved.head<2>() / moved.z() + Vec2(3e-4 * random.Gaussian(), 3e-4 * random.Gaussian());
    if (i < 40) seen += Vec2(random.Uniform(0.02, 0.1), random.Uniform(0.02, 0.1));
    points.push_back({p, seen});
  }
  base::RandomStream tries(4, "test/ransac_tries");
  const TranslationResult result = FindTranslation(points, Vec3::Zero(), 3.0 / 381.0, 40, tries);
  EXPECT_LT((result.t - t).norm(), 0.01);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(result.inlier[i], i >= 40) << i;
}

/// A fronto-parallel plane of smooth random blobs at depth z, seen by a camera at p (axes as the plane's).
Image Plane(const CameraIntrinsics& camera, const Vec3& p, double z) {
  base::RandomStream random(9, "test/blobs");
  struct Blob {
    double x, y, r, a;
  };
  std::vector<Blob> blobs;
  for (int i = 0; i < 900; ++i) {
    blobs.push_back(
        {random.Uniform(-6, 6), random.Uniform(-5, 5), random.Uniform(0.03, 0.09), random.Uniform(-90, 90)});
  }
  auto bytes = std::make_shared<std::vector<std::uint8_t>>(static_cast<std::size_t>(camera.width * camera.height));
  std::vector<double> grey(bytes->size(), 120.0);
  const double depth = z - p.z();
  for (const Blob& b : blobs) {
    const double u = camera.fx * (b.x - p.x()) / depth + camera.cx, v = camera.fy * (b.y - p.y()) / depth + camera.cy;
    const double r = camera.fx * b.r / depth;
    for (int y = std::max(0, int(v - 3 * r)); y <= std::min(camera.height - 1, int(v + 3 * r)); ++y) {
      for (int x = std::max(0, int(u - 3 * r)); x <= std::min(camera.width - 1, int(u + 3 * r)); ++x) {
        const double d2 = ((x - u) * (x - u) + (y - v) * (y - v)) / (r * r);
        grey[static_cast<std::size_t>(y * camera.width + x)] += b.a * std::exp(-d2);
      }
    }
  }
  for (std::size_t i = 0; i < grey.size(); ++i) {
    (*bytes)[i] = static_cast<std::uint8_t>(std::lround(std::clamp(grey[i], 0.0, 255.0)));
  }
  Image image;
  image.width = image.stride = camera.width;
  image.height = camera.height;
  image.bytes = bytes;
  return image;
}

TEST(StereoTracker, FollowsAndMatchesToAFractionOfAPixel) {
  const CameraIntrinsics camera = Pinhole();
  const Vec3 baseline(0.11, 0, 0);
  StereoTracker tracker({camera, camera, {base::Quat::Identity(), baseline}}, {});
  constexpr double kDepth = 4.0;
  const auto follow = [&](const Vec3& p, const Transform& X_RC) {
    return tracker.Follow(Plane(camera, p, kDepth), Plane(camera, p + baseline, kDepth), X_RC);
  };
  EXPECT_TRUE(follow(Vec3::Zero(), {}).empty());
  const std::vector<Track> first = tracker.MakeReference();
  ASSERT_GT(first.size(), 60U);
  std::size_t matched = 0;
  double sum = 0.0;  // px²
  for (const Track& t : first) {
    if (!t.right) continue;
    ++matched;
    sum += 381.0 * 381.0 * (t.left - *t.right - Vec2(0.11 / kDepth, 0.0)).squaredNorm();
  }
  EXPECT_GT(10 * matched, 9 * first.size());
  EXPECT_LT(std::sqrt(sum / static_cast<double>(matched)), 0.15);

  // Half a metre on, with a prediction that is 5 cm off; patches have grown by an eighth.
  const Vec3 moved(0.2, -0.1, 0.45);
  const std::vector<Track> second = follow(moved, {base::Quat::Identity(), moved + Vec3(0.05, 0, -0.03)});
  EXPECT_GT(10 * second.size(), 7 * first.size());
  sum = 0.0;
  for (const Track& t : second) {
    const Vec3 p = kDepth * Vec3(t.reference.homogeneous()) - moved;
    sum += 381.0 * 381.0 * (p.head<2>() / p.z() - t.left).squaredNorm();
  }
  EXPECT_LT(std::sqrt(sum / static_cast<double>(second.size())), 0.3);
}

TEST(StereoTracker, RefusesImagesOfAnotherSize) {
  const CameraIntrinsics camera = Pinhole();
  StereoTracker tracker({camera, camera, {base::Quat::Identity(), Vec3(0.11, 0, 0)}}, {});
  EXPECT_THROW(tracker.Follow({}, {}, {}), base::InputError);
}

}  // namespace
}  // namespace alula::stack::features::test
