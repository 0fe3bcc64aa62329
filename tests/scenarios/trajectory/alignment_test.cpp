#include "scenarios/trajectory/alignment.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <numbers>

#include "scenarios/trajectory/four_dof_alignment.h"
#include "tests/scenarios/trajectory/walks.h"

namespace alula::scenarios::trajectory {
namespace {

using base::Vec3;
using testing::At;

const base::Transform kTurn{base::FromYawPitchRoll(2.0, -0.7, 0.4), {10, -20, 3}};

/// Pairs whose estimate is X⁻¹ (truth + noise) / scale.
std::vector<PosePair> Pairs(const base::Transform& X, double scale, double sigma, std::uint64_t seed) {
  const auto truth = testing::Walk(300, 10);
  const auto estimate = testing::Disturbed(truth, X.Inverse(), sigma, 0, seed);
  std::vector<PosePair> pairs = Associate(estimate, truth);
  for (PosePair& pair : pairs) pair.estimate.p /= scale;
  return pairs;
}

TEST(TruthAt, FollowsAConstantTurnAndAStraightLine) {
  std::vector<base::StampedPose> truth;
  for (int i = 0; i < 5; ++i) truth.push_back({At(0.1 * i), {base::FromYaw(0.3 * i), {2.0 * i, -1.0 * i, 0.5}}});
  for (const double t : {0.0, 0.013, 0.1, 0.25, 0.3999, 0.4}) {
    const auto X = TruthAt(truth, At(t));
    ASSERT_TRUE(X) << t;
    EXPECT_NEAR((X->p - Vec3(20 * t, -10 * t, 0.5)).norm(), 0, 1e-12);
    EXPECT_NEAR(base::Log(X->q.conjugate() * base::FromYaw(3 * t)).norm(), 0, 1e-12);
  }
  EXPECT_FALSE(TruthAt(truth, At(-1e-9)));
  EXPECT_FALSE(TruthAt(truth, At(0.4 + 1e-9)));
  EXPECT_FALSE(TruthAt({}, At(0)));
  truth.erase(truth.begin() + 2);  // a gap of 0.2 s
  EXPECT_FALSE(TruthAt(truth, At(0.2)));
  EXPECT_TRUE(TruthAt(truth, At(0.1)));
  EXPECT_TRUE(TruthAt(truth, At(0.3)));
  EXPECT_TRUE(TruthAt(truth, At(0.2), base::Seconds(0.2)));
}

TEST(Align, FindsWhatWasDone) {
  const base::Transform level{base::FromYaw(-2.5), {100, 200, -30}};
  for (const auto& [freedom, X, scale] :
       {std::tuple{Freedom::kNone, base::Transform{}, 1.0}, std::tuple{Freedom::kYaw, level, 1.0},
        std::tuple{Freedom::kRigid, kTurn, 1.0}, std::tuple{Freedom::kSimilarity, kTurn, 0.37}}) {
    const AbsoluteError error = AbsoluteErrorOf(Pairs(X, scale, 0, 1), freedom);
    EXPECT_EQ(error.position.count, 300);
    EXPECT_LT(error.position.max, 1e-10);
    EXPECT_LT(error.rotation.max, 1e-5);  // deg; acos-like loss at 1
    EXPECT_NEAR(error.alignment.scale, scale, 1e-12);
    EXPECT_NEAR((error.alignment.X_TE.p - X.p).norm(), 0, 1e-9);
    EXPECT_NEAR(base::Log(error.alignment.X_TE.q.conjugate() * X.q).norm(), 0, 1e-10);
  }
}

TEST(Align, FewerFreedomsLeaveTheRest) {
  const std::vector<PosePair> shifted = Pairs({base::Quat::Identity(), {3, 4, 0}}, 1, 0, 1);
  EXPECT_NEAR(AbsoluteErrorOf(shifted, Freedom::kNone).position.rmse, 5, 1e-12);
  EXPECT_NEAR(AbsoluteErrorOf(shifted, Freedom::kNone).position.median, 5, 1e-12);
  const std::vector<PosePair> turned = Pairs({base::FromYaw(0.5), Vec3::Zero()}, 1, 0, 1);
  EXPECT_NEAR(AbsoluteErrorOf(turned, Freedom::kNone).rotation.mean, 0.5 * 180 / std::numbers::pi, 1e-9);
  const std::vector<PosePair> scaled = Pairs(kTurn, 1.25, 0, 1);
  EXPECT_GT(AbsoluteErrorOf(scaled, Freedom::kRigid).position.rmse, 0.1);
}

/// n·RMSE² of noise of σ per axis is σ² times chi-square of 3n − freedoms; the mean of χ² is its degrees k, its
/// deviation √(2k). Four deviations.
TEST(Align, NoiseOfKnownSizeIsMeasured) {
  constexpr double kSigma = 0.05;
  for (const auto& [freedom, lost] : {std::pair{Freedom::kNone, 0}, std::pair{Freedom::kYaw, 4},
                                      std::pair{Freedom::kRigid, 6}, std::pair{Freedom::kSimilarity, 7}}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      const AbsoluteError error = AbsoluteErrorOf(Pairs({}, 1, kSigma, seed), freedom);
      const double k = 3.0 * 300 - lost;
      const double chi = 300 * std::pow(error.position.rmse / kSigma, 2);
      EXPECT_NEAR(chi, k, 4 * std::sqrt(2 * k)) << "freedom " << static_cast<int>(freedom) << " seed " << seed;
    }
  }
}

TEST(Align, TheCriterionsRunningSumsSayTheSame) {
  const std::vector<PosePair> pairs = Pairs({base::FromYaw(1.1), {500, -300, 20}}, 1, 0.3, 6);
  FourDofAlignment sums;
  for (const PosePair& pair : pairs) sums.Add(pair.estimate.p, pair.truth.p);
  EXPECT_NEAR(sums.AlignedRmse(), AbsoluteErrorOf(pairs, Freedom::kYaw).position.rmse, 1e-9);
  EXPECT_NEAR(sums.UnalignedRmse(), AbsoluteErrorOf(pairs, Freedom::kNone).position.rmse, 1e-9);
}

/// Horn 1987: the best turn as a quaternion is the eigenvector of the largest eigenvalue of a symmetric 4×4 matrix,
/// found here by plain power iteration. Independent of the singular value decomposition.
base::Quat HornTurn(const std::vector<PosePair>& pairs) {
  Vec3 e = Vec3::Zero(), t = Vec3::Zero();
  for (const PosePair& pair : pairs) {
    e += pair.estimate.p / static_cast<double>(pairs.size());
    t += pair.truth.p / static_cast<double>(pairs.size());
  }
  Eigen::Matrix4d N = Eigen::Matrix4d::Zero();
  for (const PosePair& pair : pairs) {
    // |t' − q e' q⁻¹|² = |t' q − q e'|²: linear in q.
    const Vec3 a = pair.truth.p - t, b = pair.estimate.p - e;
    Eigen::Matrix4d L = Eigen::Matrix4d::Zero();  // of (w, x, y, z)
    L.block<1, 3>(0, 1) = -(a - b).transpose();
    L.block<3, 1>(1, 0) = a - b;
    L.block<3, 3>(1, 1) = base::Hat(a) + base::Hat(b);
    N -= L.transpose() * L;
  }
  N += 2 * N.norm() * Eigen::Matrix4d::Identity();
  Eigen::Vector4d q(0.5, 0.5, 0.5, 0.5);
  for (int i = 0; i < 20'000; ++i) q = (N * q).normalized();
  return {q[0], q[1], q[2], q[3]};
}

TEST(Align, AgreesWithHornsQuaternion) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const std::vector<PosePair> pairs = Pairs(kTurn, 1, 0.8, seed);
    const base::Quat q = Align(pairs, Freedom::kRigid).X_TE.q;
    EXPECT_NEAR(base::Log(q.conjugate() * HornTurn(pairs)).norm(), 0, 1e-6) << seed;
  }
}

TEST(Align, NothingNearbyIsBetter) {
  const std::vector<PosePair> pairs = Pairs(kTurn, 0.8, 0.5, 3);
  base::RandomStream random(1, "nearby");
  for (const Freedom freedom : {Freedom::kYaw, Freedom::kRigid, Freedom::kSimilarity}) {
    const Similarity best = Align(pairs, freedom);
    const auto squares = [&](const Similarity& s) {
      double sum = 0;
      for (const PosePair& pair : pairs) sum += (s * pair.estimate.p - pair.truth.p).squaredNorm();
      return sum;
    };
    for (int i = 0; i < 200; ++i) {
      Similarity other = best;
      const Vec3 turn = 1e-3 * random.GaussianVec3();
      // About the points' own middle, so that turn and shift do not fight.
      other.X_TE =
          base::Transform{base::Exp(freedom == Freedom::kYaw ? Vec3(0, 0, turn.z()) : turn), Vec3::Zero()} * other.X_TE;
      other.X_TE.p += 1e-3 * random.GaussianVec3();
      if (freedom == Freedom::kSimilarity) other.scale *= 1 + 1e-3 * random.Gaussian();
      EXPECT_GT(squares(other), squares(best));
    }
  }
}

TEST(Align, PointsThatDetermineNoTurnStayFinite) {
  // In a plane, where a mirror image would fit as well as a turn.
  std::vector<PosePair> flat = Pairs(kTurn, 1, 0, 1);
  for (PosePair& pair : flat) pair.estimate.p.z() = 0;
  const Similarity in_plane = Align(flat, Freedom::kRigid);
  EXPECT_NEAR(in_plane.X_TE.R().determinant(), 1, 1e-12);
  // On a line, in a point, and none at all.
  std::vector<PosePair> line;
  for (int i = 0; i < 9; ++i) line.push_back({At(i), {{}, Vec3(0, 0, i)}, {{}, Vec3(1.0 * i, 0, 0)}});
  for (PosePair& pair : line) pair.estimate.q = pair.truth.q = base::Quat::Identity();
  EXPECT_LT(AbsoluteErrorOf(line, Freedom::kRigid).position.max, 1e-12);
  const std::vector<PosePair> point(5, PosePair{At(0), {}, {base::Quat::Identity(), {7, 8, 9}}});
  for (const Freedom freedom : {Freedom::kYaw, Freedom::kRigid, Freedom::kSimilarity}) {
    const AbsoluteError error = AbsoluteErrorOf(point, freedom);
    EXPECT_LT(error.position.max, 1e-12);
    EXPECT_EQ(error.alignment.scale, 1);
    EXPECT_EQ(AbsoluteErrorOf({}, freedom).position.count, 0);
    EXPECT_TRUE(std::isinf(AbsoluteErrorOf({}, freedom).position.rmse));
  }
}

TEST(Statistics, OfKnownValues) {
  std::vector<double> values;
  for (int i = 100; i >= 0; --i) values.push_back(i);
  const Statistics s = StatisticsOf(values);
  EXPECT_EQ(s.count, 101);
  EXPECT_EQ(s.mean, 50);
  EXPECT_EQ(s.median, 50);
  EXPECT_EQ(s.p99, 99);
  EXPECT_EQ(s.max, 100);
  EXPECT_NEAR(s.rmse, std::sqrt(100 * 201 / 6.0), 1e-12);  // Σ k² = n (n+1) (2n+1) / 6, over n + 1
  EXPECT_TRUE(std::isinf(StatisticsOf({}).median));
}

}  // namespace
}  // namespace alula::scenarios::trajectory
