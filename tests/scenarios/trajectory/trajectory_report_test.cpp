#include "scenarios/trajectory/trajectory_report.h"

#include <gtest/gtest.h>

#include "tests/scenarios/trajectory/walks.h"

namespace alula::scenarios::trajectory {
namespace {

std::vector<base::Time> Stamps(const std::vector<base::StampedPose>& poses) {
  std::vector<base::Time> times;
  for (const base::StampedPose& pose : poses) times.push_back(pose.time);
  return times;
}

TEST(TrajectoryReport, OfAnEstimateOfKnownFaults) {
  const auto truth = testing::Walk(600, 20);
  // Shifted and turned about the vertical: nothing is left after 4-DoF alignment.
  const base::Transform X{base::FromYaw(0.7), {3, 4, 0}};
  const auto estimate = testing::Disturbed(truth, X, 0, 0, 1);
  const TrajectoryReport report = Judge(estimate, truth, {.images = Stamps(truth)});
  EXPECT_EQ(report.pairs, 600);
  EXPECT_EQ(report.completeness.share(), 1);
  EXPECT_LT(report.yaw_aligned.position.max, 1e-10);
  EXPECT_LT(report.rigidly_aligned.position.max, 1e-10);
  EXPECT_GT(report.unaligned.position.rmse, 1);
  EXPECT_FALSE(report.scaled);
  EXPECT_LT(report.second.translation.max, 1e-10);
  EXPECT_LT(report.end.metres, 1e-10);
  const auto metrics = MetricsOf({"online", report});
  EXPECT_LT(metrics.at("ate_online_m"), 1e-10);
  EXPECT_EQ(metrics.at("completeness_online"), 1);
  EXPECT_EQ(metrics.at("ate_unaligned_online_m"), report.unaligned.position.rmse);
  EXPECT_EQ(metrics.at("end_error_online_percent"), report.end.percent);
  EXPECT_FALSE(metrics.contains("ate_sim3_online_m"));
}

TEST(TrajectoryReport, AFreeScaleIsTakenOutBeforeWaysAreMeasured) {
  const auto truth = testing::Walk(600, 20);
  auto estimate = truth;
  for (base::StampedPose& pose : estimate) pose.X_FS.p *= 0.25;
  const ReportRequest request{.images = Stamps(truth), .scale_is_free = true};
  const TrajectoryReport report = Judge(estimate, truth, request);
  ASSERT_TRUE(report.scaled);
  EXPECT_NEAR(report.scaled->alignment.scale, 4, 1e-9);
  EXPECT_LT(report.scaled->position.max, 1e-9);
  EXPECT_GT(report.rigidly_aligned.position.rmse, 1);
  EXPECT_LT(report.metre.translation.max, 1e-9);
  EXPECT_LT(report.end.percent, 1e-7);
  EXPECT_TRUE(MetricsOf({"final", report}).contains("ate_sim3_final_m"));
}

TEST(TrajectoryReport, TheTableHasAColumnForEachAndNoAteWithoutCompleteness) {
  const auto truth = testing::Walk(200, 20);
  const TrajectoryReport all = Judge(truth, truth, {.images = Stamps(truth)});
  const TrajectoryReport none = Judge({}, truth, {.images = Stamps(truth)});
  const std::string table = ToTable({{"online", none}, {"final", all}});
  EXPECT_NE(table.find("online"), std::string::npos);
  EXPECT_NE(table.find("final"), std::string::npos);
  EXPECT_LT(table.find("completeness"), table.find("ATE, 4-DoF"));
  EXPECT_NE(table.find("  -        0.0000 m"), std::string::npos) << table;
  EXPECT_EQ(table.find("inf"), std::string::npos) << table;
  EXPECT_EQ(table.find("Sim(3)"), std::string::npos) << table;
  // Without any truth there is completeness alone.
  const std::string bare = ToTable({{"online", Judge(truth, {}, {.images = Stamps(truth)})}});
  EXPECT_NE(bare.find("completeness"), std::string::npos);
  EXPECT_EQ(bare.find("ATE"), std::string::npos);
  EXPECT_EQ(MetricsOf({"online", none}).at("completeness_online"), 0);
  EXPECT_FALSE(MetricsOf({"online", none}).contains("ate_online_m"));
}

}  // namespace
}  // namespace alula::scenarios::trajectory
