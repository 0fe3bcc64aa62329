#include "stack/slam/relative_pose.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"
#include "stack/features/pose_solvers.h"
#include "stack/slam/internal/place_residual.h"

namespace alula::stack::slam {
namespace {

using base::Transform;
using base::Vec2;
using base::Vec3;
using base::Vec6;

constexpr double kFocal = 458.0, kFocalBaseline = kFocal * 0.11;
constexpr double kDegree = std::numbers::pi / 180;

features::Descriptor RandomDescriptor(base::RandomStream& random) {
  return {random.Bits(), random.Bits(), random.Bits(), random.Bits()};
}
features::Descriptor Worn(features::Descriptor d, int bits, base::RandomStream& random) {
  for (int i = 0; i < bits; ++i) d[random.Index(4)] ^= 1ULL << random.Index(64);
  return d;
}

/// Where a camera sees a point, with the noise that the estimator expects.
struct Sight {
  Vec2 normalised;
  std::optional<Vec3> p_C;
};
Sight See(const Vec3& p_C, bool depth, double noise, base::RandomStream& random) {
  Sight sight;
  sight.normalised = p_C.head<2>() / p_C.z() + noise / kFocal * Vec2(random.Gaussian(), random.Gaussian());
  const double disparity = kFocalBaseline / p_C.z() + 0.7 * noise * random.Gaussian();
  if (depth && disparity > 1.0) sight.p_C = kFocalBaseline / disparity * sight.normalised.homogeneous();
  return sight;
}

struct Scene {
  PlaceView a, b;
  Transform X_AB;
  std::vector<Vec3> points_A;
};

struct SceneConfig {
  int common = 120, others = 200;
  bool depth_a = true, depth_b = true, gravity = false;
  double noise = 1.0;
};

/// A room's corners seen by two cameras with a roughly common direction; others only one of them sees.
Scene MakeScene(std::uint64_t seed, const SceneConfig& config) {
  base::RandomStream random(seed, "test/scene");
  Scene scene;
  scene.X_AB = {base::Exp(Vec3(0.15 * random.Gaussian(), 0.25 * random.Gaussian(), 0.3 * random.Gaussian())),
                Vec3(0.4 * random.Gaussian(), 0.2 * random.Gaussian(), 0.4 * random.Gaussian())};
  for (PlaceView* view : {&scene.a, &scene.b}) {
    view->focal = kFocal;
    view->focal_baseline = kFocalBaseline;
  }
  const auto add = [&](PlaceView& view, const Sight& sight, const features::Descriptor& descriptor) {
    PlacePoint point;
    point.pixel = kFocal * sight.normalised;
    point.normalised = sight.normalised;
    point.p_C = sight.p_C;
    point.descriptor = descriptor;
    view.points.push_back(point);
  };
  const auto draw = [&] {
    const double z = random.Uniform(2.0, 9.0);
    return Vec3(z * random.Uniform(-0.7, 0.7), z * random.Uniform(-0.45, 0.45), z);
  };
  const Transform X_BA = scene.X_AB.Inverse();
  for (int i = 0; i < config.common;) {
    const Vec3 p_A = draw(), p_B = X_BA * p_A;
    if (p_B.z() < 0.5) continue;
    const features::Descriptor d = RandomDescriptor(random);
    add(scene.a, See(p_A, config.depth_a, config.noise, random), d);
    add(scene.b, See(p_B, config.depth_b, config.noise, random), Worn(d, 30, random));
    scene.points_A.push_back(p_A);
    ++i;
  }
  for (int i = 0; i < config.others; ++i) {
    add(scene.a, See(draw(), config.depth_a, config.noise, random), RandomDescriptor(random));
    add(scene.b, See(draw(), config.depth_b, config.noise, random), RandomDescriptor(random));
    if (i % 4 == 0) {  // a pair that looks alike and is not
      scene.b.points.back().descriptor = Worn(scene.a.points.back().descriptor, 25, random);
    }
  }
  if (config.gravity) {
    const Vec3 up_A = Vec3(0.1, -1.0, 0.2).normalized();
    const auto off = [&] { return base::Exp(0.5 * kDegree * random.GaussianVec3()); };
    scene.a.up_C = off() * up_A;
    scene.b.up_C = off() * Vec3(X_BA.q * up_A);
  }
  return scene;
}

/// Share of what should be seen: half of these views is not common.
RelativePoseConfig Config() {
  RelativePoseConfig config;
  config.min_share = 0.15;
  return config;
}

double TurnError(const Transform& a, const Transform& b) { return base::Log(a.q.conjugate() * b.q).norm(); }

TEST(PoseSolvers, GiveThePoseAmongTheirAnswers) {
  base::RandomStream random(1, "test/solvers");
  for (int i = 0; i < 200; ++i) {
    const Transform X_TS{base::Exp(0.8 * random.GaussianVec3()), 0.5 * random.GaussianVec3()};
    std::array<features::PointAndRay, 3> points;
    bool front = true;
    for (features::PointAndRay& p : points) {
      p.p = X_TS.Inverse() * Vec3(random.Uniform(-2, 2), random.Uniform(-2, 2), random.Uniform(1, 6));
      const Vec3 q = X_TS * p.p;
      front = front && q.z() > 0;
      p.seen = q.head<2>() / q.z();
    }
    const Vec3 up_S = random.GaussianVec3().normalized(), up_T = X_TS.q * up_S;
    const auto nearest = [&](const std::vector<Transform>& poses) {
      double best = 1e9;
      for (const Transform& X : poses) best = std::min(best, TurnError(X, X_TS) + (X.p - X_TS.p).norm());
      return best;
    };
    ASSERT_TRUE(front);
    EXPECT_LT(nearest(features::SolveThreePoints(points)), 1e-4) << i;
    EXPECT_LT(nearest(features::SolveTwoPoints({points[0], points[1]}, up_S, up_T)), 1e-6) << i;
  }
}

TEST(PlaceResidual, JacobianAgreesWithPerturbation) {
  for (const bool depth_a : {true, false}) {
    const Scene scene = MakeScene(3, {.depth_a = depth_a});
    const Transform X_BA = scene.X_AB.Inverse();
    for (std::size_t i = 0; i < 20; ++i) {
      const PlacePoint &a = scene.a.points[i], &b = scene.b.points[i];
      const auto at = internal::ResidualOf(scene.a, a, scene.b, b, X_BA, Config());
      if (!at) continue;
      for (int k = 0; k < 6; ++k) {
        constexpr double kStep = 1e-6;
        const auto moved = [&](double step) {
          Vec6 d = Vec6::Zero();
          d[k] = step;
          const Transform X{X_BA.q * base::Exp(d.tail<3>()), X_BA.p + d.head<3>()};
          return internal::ResidualOf(scene.a, a, scene.b, b, X, Config())->r;
        };
        const Vec3 difference = (moved(kStep) - moved(-kStep)) / (2 * kStep);
        EXPECT_LT((difference - at->jacobian.col(k)).norm(), 1e-5 * std::max(1.0, difference.norm()));
      }
    }
  }
}

struct Case {
  const char* name;
  SceneConfig scene;
  double metres, degrees;  // of the median pose
};

TEST(RelativePose, IsFoundWithDepthAtOneEndOrBothAndWithGravity) {
  const std::vector<Case> cases = {{"both", {}, 0.03, 0.4},
                                   {"a only", {.depth_b = false}, 0.05, 0.6},
                                   {"b only", {.depth_a = false}, 0.05, 0.6},
                                   {"gravity", {.gravity = true}, 0.03, 0.4},
                                   {"few", {.common = 45, .gravity = true}, 0.05, 0.6}};
  for (const Case& c : cases) {
    std::vector<double> metres, degrees;
    int accepted = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const Scene scene = MakeScene(seed, c.scene);
      RelativePoseConfig config = Config();
      config.min_share = 0.1;
      const RelativePose pose = EstimateRelativePose(scene.a, scene.b, config, seed);
      if (!pose.accepted) continue;
      ++accepted;
      metres.push_back((pose.X_AB.p - scene.X_AB.p).norm());
      degrees.push_back(TurnError(pose.X_AB, scene.X_AB) / kDegree);
    }
    ASSERT_GE(accepted, 18) << c.name;
    std::sort(metres.begin(), metres.end());
    std::sort(degrees.begin(), degrees.end());
    std::printf("%-8s %d of 20, median %.3f m %.2f deg, worst %.3f m %.2f deg\n", c.name, accepted,
                metres[metres.size() / 2], degrees[degrees.size() / 2], metres.back(), degrees.back());
    EXPECT_LT(metres[metres.size() / 2], c.metres) << c.name;
    EXPECT_LT(degrees[degrees.size() / 2], c.degrees) << c.name;
    EXPECT_LT(metres.back(), 0.3) << c.name;
  }
}

TEST(RelativePose, KnowsHowSureItIs) {
  double nees = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Scene scene = MakeScene(100 + seed, {.gravity = seed % 2 == 0});
    const RelativePose pose = EstimateRelativePose(scene.a, scene.b, Config(), seed);
    if (!pose.accepted) continue;
    Vec6 error;
    error.head<3>() = scene.X_AB.p - pose.X_AB.p;
    error.tail<3>() = base::Log(pose.X_AB.q.conjugate() * scene.X_AB.q);
    nees += error.dot(pose.covariance.inverse() * error);
    ++count;
  }
  ASSERT_GE(count, 55);
  // 6 on average; the mean of 55 has 1σ = √(12/55) = 0.47. The gate cuts the tails and the window takes in few wrong
  // ones.
  EXPECT_NEAR(nees / count, 6.0, 1.9);
}

TEST(RelativePose, RefusesWhatIsNotTheSamePlace) {
  int accepted = 0;
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const Scene one = MakeScene(seed, {.gravity = true}), other = MakeScene(seed + 500, {.gravity = true});
    const RelativePose pose = EstimateRelativePose(one.a, other.b, Config(), seed);
    accepted += pose.accepted;
    EXPECT_FALSE(pose.reason.empty());
  }
  EXPECT_EQ(accepted, 0);
}

TEST(RelativePose, RefusesInliersInOneSpot) {
  // All that is common is one poster, 0.3 m wide, 3 m away.
  Scene scene = MakeScene(5, {.common = 80, .others = 0});
  base::RandomStream random(5, "test/poster");
  const Transform X_BA = scene.X_AB.Inverse();
  for (std::size_t i = 0; i < 80; ++i) {
    const Vec3 p_A(random.Uniform(-0.06, 0.06), random.Uniform(-0.06, 0.06), 3.0);
    for (const bool of_a : {true, false}) {
      const Sight sight = See(of_a ? p_A : Vec3(X_BA * p_A), true, 1.0, random);
      PlacePoint& point = (of_a ? scene.a : scene.b).points[i];
      point.normalised = sight.normalised;
      point.p_C = sight.p_C;
    }
  }
  const RelativePose pose = EstimateRelativePose(scene.a, scene.b, Config(), 1);
  EXPECT_FALSE(pose.accepted);
  EXPECT_NE(pose.reason.find("spot"), std::string::npos) << pose.reason;
}

TEST(RelativePose, SaysWhyWithoutDepthsOrMatches) {
  const Scene blind = MakeScene(6, {.depth_a = false, .depth_b = false});
  EXPECT_NE(EstimateRelativePose(blind.a, blind.b, {}, 1).reason.find("matches with depth"), std::string::npos);
  EXPECT_FALSE(EstimateRelativePose({}, {}, {}, 1).accepted);
}

TEST(RelativePose, IsTheSameEveryTime) {
  const Scene scene = MakeScene(7, {});
  const RelativePose one = EstimateRelativePose(scene.a, scene.b, {}, 9),
                     two = EstimateRelativePose(scene.a, scene.b, {}, 9);
  EXPECT_EQ(one.X_AB.p, two.X_AB.p);
  EXPECT_EQ(one.X_AB.q.coeffs(), two.X_AB.q.coeffs());
  EXPECT_EQ(one.inliers.size(), two.inliers.size());
}

}  // namespace
}  // namespace alula::stack::slam
