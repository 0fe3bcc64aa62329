#include "stack/features/pose_ransac.h"

#include <gtest/gtest.h>

namespace alula::stack::features {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPixel = 1.0 / 458.0, kGate = 3.0 * kPixel;

struct Scene {
  Transform X_TS;
  std::vector<PointAndRay> points;
  std::vector<bool> right;  // seen where they are, but for noise
};

Scene MakeScene(std::uint64_t seed, int count, double wrong) {
  base::RandomStream random(seed, "test/pose_ransac");
  Scene scene;
  scene.X_TS = {base::Exp(0.3 * random.GaussianVec3()), 0.5 * random.GaussianVec3()};
  for (int i = 0; i < count; ++i) {
    const double z = random.Uniform(1.5, 9.0);
    const Vec3 p_T(z * random.Uniform(-0.8, 0.8), z * random.Uniform(-0.5, 0.5), z);
    const bool right = random.Uniform() >= wrong;
    const Vec2 seen = right ? Vec2(p_T.head<2>() / z + 0.5 * kPixel * Vec2(random.Gaussian(), random.Gaussian()))
                            : Vec2(random.Uniform(-0.8, 0.8), random.Uniform(-0.5, 0.5));
    scene.points.push_back({scene.X_TS.Inverse() * p_T, seen});
    scene.right.push_back(right);
  }
  return scene;
}

double Distance(const Transform& a, const Transform& b) {
  return (a.p - b.p).norm() + base::Log(a.q.conjugate() * b.q).norm();
}

TEST(PoseRansac, FindsThePoseAmongOutliersWithoutAGuess) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Scene scene = MakeScene(seed, 100, 0.4);
    base::RandomStream random(seed, "test/trials");
    const PoseResult pose = FindPose(scene.points, Transform(), kGate, 100, random);
    EXPECT_LT(Distance(pose.X_TS, scene.X_TS), 0.01) << seed;
    int missed = 0, wrong = 0;
    for (std::size_t i = 0; i < scene.right.size(); ++i) {
      missed += scene.right[i] && !pose.inlier[i];
      wrong += !scene.right[i] && pose.inlier[i];
    }
    EXPECT_LE(missed, 1) << seed;
    EXPECT_LE(wrong, 2) << seed;
    EXPECT_EQ(pose.inliers, std::count(pose.inlier.begin(), pose.inlier.end(), true));
  }
}

/// With four fifths of them wrong ten trials find nothing by chance; a good guess does.
TEST(PoseRansac, AGoodGuessNeedsNoChance) {
  const Scene scene = MakeScene(5, 100, 0.8);
  base::RandomStream random(5, "test/trials");
  const Transform guess{base::Exp(Vec3(0.001, -0.001, 0.001)) * scene.X_TS.q, scene.X_TS.p + Vec3(0.002, 0, 0.002)};
  const PoseResult pose = FindPose(scene.points, guess, kGate, 10, random);
  EXPECT_LT(Distance(pose.X_TS, scene.X_TS), 0.01);
}

TEST(PoseRansac, TooFewPointsGiveTheGuessBack) {
  Scene scene = MakeScene(6, 2, 0.0);
  base::RandomStream random(6, "test/trials");
  const PoseResult pose = FindPose(scene.points, scene.X_TS, kGate, 100, random);
  EXPECT_EQ(pose.X_TS.p, scene.X_TS.p);
  EXPECT_EQ(pose.inlier.size(), 2U);
  EXPECT_EQ(FindPose({}, scene.X_TS, kGate, 100, random).inliers, 0);
}

}  // namespace
}  // namespace alula::stack::features
