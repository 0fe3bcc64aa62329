#include "base/trajectory_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "base/error.h"
#include "base/random.h"

namespace alula::base {
namespace {

TEST(TrajectoryFile, WhatIsWrittenReadsBackToTheBit) {
  RandomStream random(3, "trajectory_file");
  std::vector<StampedPose> poses;
  std::string text = "# timestamp tx ty tz qx qy qz qw\n";
  for (int i = 0; i < 200; ++i) {
    const double size = std::pow(10.0, random.Uniform(-12, 7));
    const std::int64_t ns = -1'000'000'007 + std::int64_t{13'000'000} * i;  // from before the start on
    poses.push_back({{ns}, {Exp(random.GaussianVec3()), size * random.GaussianVec3()}});
    text += TumRow(poses.back());
  }
  std::istringstream stream(text);
  const std::vector<StampedPose> back = ReadTrajectory(stream, "t");
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(back[i].time, poses[i].time);
    EXPECT_EQ(back[i].X_FS.p, poses[i].X_FS.p);
    EXPECT_LT((back[i].X_FS.q.coeffs() - poses[i].X_FS.q.coeffs()).norm(), 1e-15);  // made to unit length anew
    EXPECT_EQ(back[i].line, static_cast<int>(i) + 2);
  }
}

TEST(TrajectoryFile, SecondsHaveNineDecimals) {
  EXPECT_EQ(DecimalSeconds({1305031102175304000}), "1305031102.175304000");
  EXPECT_EQ(DecimalSeconds({-1}), "-0.000000001");
  EXPECT_EQ(DecimalSeconds({}), "0.000000000");
}

TEST(TrajectoryFile, FewPosesAreRefusedWhereMoreAreWanted) {
  const std::string row = TumRow({{5}, {}});
  std::istringstream one(row), again(row), none("");
  EXPECT_THROW(ReadTrajectory(one, "t"), InputError);
  EXPECT_EQ(ReadTrajectory(again, "t", 1).size(), 1u);
  EXPECT_TRUE(ReadTrajectory(none, "t", 0).empty());
}

}  // namespace
}  // namespace alula::base
