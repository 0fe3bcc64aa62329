#include "stack/planning/trajectory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/frames.h"

namespace alula::stack::planning {
namespace {

using base::Time;
using base::Vec3;

std::vector<Vec3> Dense(const std::vector<Vec3>& corners, double spacing = 0.3) {
  std::vector<Vec3> points{corners.front()};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    const Vec3 d = corners[i] - corners[i - 1];
    const int n = static_cast<int>(std::ceil(d.norm() / spacing));
    for (int k = 1; k <= n; ++k) points.push_back(corners[i - 1] + d * (static_cast<double>(k) / n));
  }
  return points;
}

const std::vector<Vec3> kCorners{{0, 0, 1}, {4, 0, 1.4}, {5, 3, 2}, {1, 5, 2}};

/// Limits of speed, acceleration and heading; derivatives against central differences; continuity of acceleration.
void ExpectSmooth(const Trajectory& trajectory, const TrajectoryLimits& limits, double acceleration_scale = 1.0) {
  const auto h = base::Milliseconds(1);
  TrajectoryPoint last = trajectory.Sample(trajectory.start());
  for (Time t = trajectory.start() + h; t < trajectory.yaw_end(); t += h) {
    const TrajectoryPoint now = trajectory.Sample(t);
    const TrajectoryPoint next = trajectory.Sample(t + h);
    EXPECT_LE(now.v_O.norm(), limits.max_speed * 1.001);
    EXPECT_LE(now.a_O.norm(), acceleration_scale * limits.max_acceleration * 1.02);
    EXPECT_LE(std::abs(now.yaw_rate), limits.max_yaw_rate * 1.001);
    // Central differences of a cubic are exact to h²/6·jerk ≈ 1e-5.
    EXPECT_LT(((next.p_O - last.p_O) / 2e-3 - now.v_O).norm(), 1e-4);
    // Jerk is at most twice the acceleration limit a knot: 40 m/s³ makes 0.04 m/s² a millisecond.
    EXPECT_LT((now.a_O - last.a_O).norm(),
              2.1 * acceleration_scale * limits.max_acceleration / limits.knot_period * 1e-3);
    // But for the step where the turn ends (below 0.1 rad/s).
    EXPECT_NEAR((next.yaw - last.yaw) / 2e-3, now.yaw_rate, 0.12);
    last = now;
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(Curve, ArcLengthAndTangent) {
  const Curve curve(Dense(kCorners));
  EXPECT_LT((curve.Position(0) - kCorners.front()).norm(), 1e-12);
  EXPECT_LT((curve.Position(curve.length()) - kCorners.back()).norm(), 1e-12);
  for (double s = 0.2; s < curve.length() - 0.2; s += 0.13) {
    const Vec3 difference = (curve.Position(s + 0.01) - curve.Position(s - 0.01)) / 0.02;
    EXPECT_NEAR(difference.norm(), 1.0, 0.01);
    EXPECT_LT((difference.normalized() - curve.Tangent(s)).norm(), 0.01);
    const Vec3 bend = (curve.Tangent(s + 0.01) - curve.Tangent(s - 0.01)) / 0.02;
    EXPECT_NEAR(bend.norm(), curve.Curvature(s), 0.15 + 0.05 * curve.Curvature(s));
  }
  EXPECT_NEAR(curve.Nearest(curve.Position(3.0)), 3.0, 0.04);
}

TEST(Trajectory, KeepsItsLimitsFromRestToRest) {
  const TrajectoryLimits limits;
  const Curve curve(Dense(kCorners));
  TrajectoryPoint start;
  start.p_O = kCorners.front();
  const auto trajectory = Trajectory::Along(Time{5'000'000'000}, start, curve, {}, limits);
  ASSERT_TRUE(trajectory);
  ExpectSmooth(*trajectory, limits);
  const TrajectoryPoint first = trajectory->Sample(trajectory->start());
  EXPECT_LT((first.p_O - kCorners.front()).norm(), 1e-9);
  EXPECT_LT(first.v_O.norm() + first.a_O.norm(), 1e-9);
  const TrajectoryPoint end = trajectory->Sample(trajectory->end());
  EXPECT_LT((end.p_O - kCorners.back()).norm(), 1e-9);
  EXPECT_LT(end.v_O.norm() + end.a_O.norm(), 1e-9);
  // It does get somewhere: at least a metre a second over this course with two sharp corners.
  EXPECT_LT((trajectory->end() - trajectory->start()).Seconds(), curve.length());
}

TEST(Trajectory, StaysOnItsCurve) {
  const TrajectoryLimits limits;
  const Curve curve(Dense(kCorners));
  TrajectoryPoint start;
  start.p_O = kCorners.front();
  const auto trajectory = Trajectory::Along(Time{}, start, curve, {}, limits);
  ASSERT_TRUE(trajectory);
  for (Time t; t < trajectory->end(); t += base::Milliseconds(20)) {
    const Vec3 p = trajectory->Sample(t).p_O;
    // A spline of samples h apart cuts corners by a·h²/6 = 1.3 cm; the table of arc length has steps of 4 cm.
    EXPECT_LT((p - curve.Position(curve.Nearest(p))).norm(), 0.04);
  }
}

TEST(Trajectory, GoesOnFromAMovingState) {
  const TrajectoryLimits limits;
  const Curve curve(Dense(kCorners));
  TrajectoryPoint start;
  start.p_O = kCorners.front();
  const auto first = Trajectory::Along(Time{}, start, curve, {}, limits);
  ASSERT_TRUE(first);
  const Time change{1'700'000'000};
  const TrajectoryPoint state = first->Sample(change);
  ASSERT_GT(state.v_O.norm(), 1.0);
  const Vec3 begin = Trajectory::StartPoint(state, limits);
  const Vec3 ahead = begin + 0.4 * (begin - state.p_O).normalized();
  const Curve other(Dense({begin, ahead, ahead + Vec3(3, 1.5, 0)}, 0.2));
  const auto second = Trajectory::Along(change, state, other, {}, limits);
  ASSERT_TRUE(second);
  const TrajectoryPoint joined = second->Sample(change);
  EXPECT_LT((joined.p_O - state.p_O).norm(), 1e-9);
  EXPECT_LT((joined.v_O - state.v_O).norm(), 1e-9);
  EXPECT_LT((joined.a_O - state.a_O).norm(), 1e-9);
  EXPECT_NEAR(joined.yaw, state.yaw, 1e-12);
  ExpectSmooth(*second, limits, 2.0);  // it has to brake for the corner: up to twice the acceleration
}

TEST(Trajectory, StopsWhereItIsTold) {
  const TrajectoryLimits limits;
  const Curve curve(Dense(kCorners));
  TrajectoryPoint start;
  start.p_O = kCorners.front();
  const auto trajectory = Trajectory::Along(Time{}, start, curve, {.stop_at = 2.5}, limits);
  ASSERT_TRUE(trajectory);
  EXPECT_LT((trajectory->end_point() - curve.Position(2.5)).norm(), 1e-9);
  EXPECT_LT(trajectory->Sample(trajectory->end()).v_O.norm(), 1e-9);
}

TEST(Trajectory, RefusesToStopInNoRoom) {
  const TrajectoryLimits limits;
  TrajectoryPoint state;
  state.v_O = Vec3(2.2, 0, 0);
  const Vec3 begin = Trajectory::StartPoint(state, limits);
  const Curve curve(Dense({begin, begin + Vec3(5, 0, 0)}));
  EXPECT_FALSE(Trajectory::Along(Time{}, state, curve, {.stop_at = 0.2}, limits));
  EXPECT_TRUE(Trajectory::Along(Time{}, state, curve, {.stop_at = 1.2}, limits));
}

TEST(Trajectory, LooksWhereItFlies) {
  const TrajectoryLimits limits;
  const Curve curve(Dense({{0, 0, 1}, {5, 0, 1}, {5, 6, 1}}));
  TrajectoryPoint start;
  start.p_O = Vec3(0, 0, 1);
  start.yaw = 2.0;  // away from the path
  const auto trajectory = Trajectory::Along(Time{}, start, curve, {}, limits);
  ASSERT_TRUE(trajectory);
  for (Time t; t < trajectory->end(); t += base::Milliseconds(10)) {
    const TrajectoryPoint point = trajectory->Sample(t);
    if (point.v_O.norm() < 0.3) continue;
    const double course = std::atan2(point.v_O.y(), point.v_O.x());
    EXPECT_LT(std::abs(base::WrapAngle(course - point.yaw)), 0.95) << "at " << t.Seconds();
  }
  EXPECT_NEAR(trajectory->Sample(trajectory->yaw_end()).yaw, M_PI / 2, 0.1);
}

TEST(Trajectory, BrakesFromAnyState) {
  const TrajectoryLimits limits;
  TrajectoryPoint state;
  state.p_O = Vec3(1, 2, 3);
  state.v_O = Vec3(1.5, -1.2, 0.4);
  state.a_O = Vec3(0.5, 1.0, 0);
  state.yaw = -0.6;
  const Trajectory trajectory = Trajectory::Brake(Time{}, state, limits);
  EXPECT_LT((trajectory.Sample(Time{}).v_O - state.v_O).norm(), 1e-9);
  EXPECT_LT((trajectory.end_point() - state.p_O).norm(), 1.5);
  EXPECT_NEAR(trajectory.Sample(trajectory.yaw_end()).yaw, -0.6, 0.05);
}

TEST(Trajectory, TurnsThroughHeadings) {
  const TrajectoryLimits limits;
  const Trajectory turn = Trajectory::Turn(Time{}, Vec3::Zero(), 0.3, {-1.0, 2.0}, 1.2, limits);
  double low = 1, high = 0;
  for (Time t; t < turn.yaw_end(); t += base::Milliseconds(10)) {
    const TrajectoryPoint point = turn.Sample(t);
    low = std::min(low, point.yaw);
    high = std::max(high, point.yaw);
    EXPECT_LE(std::abs(point.yaw_rate), 1.2 + 1e-9);
  }
  EXPECT_NEAR(low, -1.0, 0.05);
  EXPECT_NEAR(high, 2.0, 0.05);
  EXPECT_LT(turn.yaw_end().Seconds(), 4.3 / 1.2 + 1.5);
}

}  // namespace
}  // namespace alula::stack::planning
