#include "scenarios/trajectory/relative_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "tests/scenarios/trajectory/walks.h"

namespace alula::scenarios::trajectory {
namespace {

using base::Vec3;

constexpr double kDegrees = 180 / std::numbers::pi;

/// A way of `metres` along x at 1 m/s and 10 Hz, estimated one part in a hundred too long.
std::vector<PosePair> OnePercentLong(double metres) {
  const auto truth = testing::StraightWay(static_cast<int>(10 * metres) + 1, 10);
  auto estimate = truth;
  for (base::StampedPose& pose : estimate) pose.X_FS.p *= 1.01;
  return Associate(estimate, truth);
}

TEST(RelativeError, OfOnePercentTooLongAWay) {
  const std::vector<PosePair> pairs = OnePercentLong(60);
  const RelativeError second = RelativeErrorOverTime(pairs, base::Seconds(1.0));
  EXPECT_EQ(second.translation.count, 591);
  EXPECT_NEAR(second.translation.rmse, 0.01, 1e-9);
  EXPECT_NEAR(second.translation.max, 0.01, 1e-9);
  EXPECT_LT(second.rotation.max, 1e-6);
  const RelativeError ten = RelativeErrorOverPath(pairs, 10 - 1e-6);  // 100 steps of 0.1 m round either way
  EXPECT_EQ(ten.translation.count, 501);
  EXPECT_NEAR(ten.translation.mean, 0.1, 1e-9);
  EXPECT_NEAR(ten.percent.mean, 1, 1e-6);
  EXPECT_NEAR(EndErrorOf(pairs).metres, 0.6, 1e-9);
  EXPECT_NEAR(EndErrorOf(pairs).percent, 1, 1e-6);
}

TEST(RelativeError, DriftOverTheWaysThatThereAre) {
  for (const auto& [metres, unit] : {std::pair{250.0, 100.0}, std::pair{59.95, 10.0}, std::pair{5.05, 1.0}}) {
    const PathDrift drift = PathDriftOf(OnePercentLong(metres));
    EXPECT_EQ(drift.unit, unit);
    EXPECT_GT(drift.ways, 0);
    // A way ends at the first pair beyond its length: at most a step of 0.1 m further.
    EXPECT_GE(drift.percent, 1 - 1e-6);
    EXPECT_LE(drift.percent, 1 + 0.1 / unit);
    EXPECT_LT(drift.degrees_per_metre, 1e-6);
  }
  EXPECT_EQ(PathDriftOf(OnePercentLong(0.5)).ways, 0);
  EXPECT_EQ(PathDriftOf({}).ways, 0);
  // 100 m once from each tenth pair up to 150 m, 200 m up to 50 m: 151 and 51 of them, the last of either by rounding.
  EXPECT_NEAR(static_cast<double>(PathDriftOf(OnePercentLong(250.05)).ways), 151 + 51, 0.5);
}

TEST(RelativeError, OfATurnThatDrifts) {
  constexpr double kRate = 0.02;  // rad/s, about the vertical, at 1 m/s
  const auto truth = testing::StraightWay(1201, 10);
  auto estimate = truth;
  for (base::StampedPose& pose : estimate) pose.X_FS.q = base::FromYaw(kRate * pose.time.Seconds());
  const std::vector<PosePair> pairs = Associate(estimate, truth);
  const RelativeError second = RelativeErrorOverTime(pairs, base::Seconds(1.0));
  EXPECT_NEAR(second.rotation.mean, kRate * kDegrees, 1e-7);
  EXPECT_NEAR(second.rotation.max, kRate * kDegrees, 1e-7);
  const PathDrift drift = PathDriftOf(pairs);
  EXPECT_EQ(drift.unit, 100);
  EXPECT_NEAR(drift.degrees_per_metre, kRate * kDegrees, 0.001 * kRate * kDegrees);
  // The estimate's steps lie in its turned axes: over a second the way of 1 m is seen turned by the attitude at its
  // begin, |R(−ψ) x − x| = 2 sin(ψ/2); the largest is at the last second, ψ = 119 s · rate.
  EXPECT_NEAR(second.translation.max, 2 * std::sin(119 * kRate / 2), 1e-6);
}

TEST(RelativeError, NeedsNoAlignment) {
  const auto truth = testing::Walk(400, 20);
  const auto estimate = testing::Disturbed(truth, {}, 0.02, 0.01, 5);
  auto moved = estimate;
  const base::Transform X{base::FromYawPitchRoll(1, 2, 3), {50, 60, 70}};
  for (base::StampedPose& pose : moved) pose.X_FS = X * pose.X_FS;
  const std::vector<PosePair> a = Associate(estimate, truth), b = Associate(moved, truth);
  EXPECT_NEAR(RelativeErrorOverTime(a, base::Seconds(1)).translation.rmse,
              RelativeErrorOverTime(b, base::Seconds(1)).translation.rmse, 1e-10);
  EXPECT_NEAR(RelativeErrorOverPath(a, 1).percent.median, RelativeErrorOverPath(b, 1).percent.median, 1e-8);
  EXPECT_NEAR(EndErrorOf(a).metres, EndErrorOf(b).metres, 1e-10);
}

/// By the definition with matrices, and every j tried for every i.
TEST(RelativeError, AgreesWithBruteForce) {
  const auto truth = testing::Walk(500, 25);
  auto estimate = testing::Disturbed(truth, {}, 0.05, 0.02, 8);
  estimate.erase(estimate.begin() + 100, estimate.begin() + 160);  // 2.4 s without a pose
  const std::vector<PosePair> pairs = Associate(estimate, truth);
  const auto matrix = [](const base::Transform& X) {
    Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
    M.topLeftCorner<3, 3>() = X.R();
    M.topRightCorner<3, 1>() = X.p;
    return M;
  };
  const auto error = [&](std::size_t i, std::size_t j) {
    const Eigen::Matrix4d F = (matrix(pairs[i].truth).inverse() * matrix(pairs[j].truth)).inverse() *
                              (matrix(pairs[i].estimate).inverse() * matrix(pairs[j].estimate));
    const double cosine = 0.5 * (F.topLeftCorner<3, 3>().trace() - 1);
    return std::pair{F.topRightCorner<3, 1>().norm(), std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegrees};
  };
  double squares = 0, degrees = 0, percent = 0;
  int seconds = 0, ways = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    std::size_t nearest = i;
    for (std::size_t j = 0; j < pairs.size(); ++j) {
      const auto off = [&](std::size_t k) { return std::abs((pairs[k].time - pairs[i].time).Seconds() - 1.0); };
      if (off(j) < off(nearest)) nearest = j;
    }
    const double late = (pairs[nearest].time - pairs[i].time).Seconds() - 1.0;
    if (std::abs(late) < 0.05 && pairs.back().time - pairs[i].time >= base::Seconds(1)) {
      squares += std::pow(error(i, nearest).first, 2);
      degrees += error(i, nearest).second;
      ++seconds;
    }
    double path = 0;
    for (std::size_t j = i + 1; j < pairs.size(); ++j) {
      path += (pairs[j].truth.p - pairs[j - 1].truth.p).norm();
      if (path < 2) continue;
      percent += 100 * error(i, j).first / path;
      ++ways;
      break;
    }
  }
  const RelativeError over_time = RelativeErrorOverTime(pairs, base::Seconds(1));
  EXPECT_EQ(over_time.translation.count, seconds);
  EXPECT_LT(seconds, static_cast<int>(pairs.size()) - 25);  // the gap has taken some
  EXPECT_NEAR(over_time.translation.rmse, std::sqrt(squares / seconds), 1e-9);
  EXPECT_NEAR(over_time.rotation.mean, degrees / seconds, 1e-6);
  const RelativeError over_path = RelativeErrorOverPath(pairs, 2);
  EXPECT_EQ(over_path.percent.count, ways);
  EXPECT_NEAR(over_path.percent.mean, percent / ways, 1e-9);
}

}  // namespace
}  // namespace alula::scenarios::trajectory
