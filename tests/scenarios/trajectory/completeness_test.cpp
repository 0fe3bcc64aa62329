#include "scenarios/trajectory/completeness.h"

#include <gtest/gtest.h>

#include "tests/scenarios/trajectory/walks.h"

namespace alula::scenarios::trajectory {
namespace {

using testing::At;

std::vector<base::Time> Images(int first, int last) {  // at 10 Hz
  std::vector<base::Time> times;
  for (int i = first; i <= last; ++i) times.push_back(At(0.1 * i));
  return times;
}

std::vector<base::StampedPose> Poses(int first, int last, double shift = 0) {
  std::vector<base::StampedPose> poses;
  for (int i = first; i <= last; ++i) poses.push_back({At(0.1 * i + shift), {}});
  return poses;
}

TEST(Completeness, CountsImagesThatTheTruthCovers) {
  const std::vector<base::StampedPose> truth = {{At(1.0), {}}, {At(8.95), {}}};
  const Completeness c = CompletenessOf(Images(0, 99), Poses(0, 99), truth);
  EXPECT_EQ(c.images, 80);  // 1.0 … 8.9
  EXPECT_EQ(c.with_pose, 80);
  EXPECT_EQ(c.share(), 1);
  EXPECT_EQ(c.until_first.ns, 0);
  EXPECT_EQ(c.longest_gap, base::Milliseconds(100));
  EXPECT_EQ(CompletenessOf(Images(0, 99), Poses(0, 99), {}).images, 100);
}

TEST(Completeness, BeginGapAndEndAreTold) {
  std::vector<base::StampedPose> estimate = Poses(20, 40);
  const auto rest = Poses(60, 79);
  estimate.insert(estimate.end(), rest.begin(), rest.end());
  const Completeness c = CompletenessOf(Images(0, 99), estimate, {});
  EXPECT_EQ(c.with_pose, 21 + 20);
  EXPECT_EQ(c.until_first, base::Seconds(2.0));
  EXPECT_EQ(c.longest_gap, base::Seconds(2.0));  // from 4.0 to 6.0, and from 7.9 to the last image at 9.9
  estimate.resize(estimate.size() - 5);
  EXPECT_EQ(CompletenessOf(Images(0, 99), estimate, {}).longest_gap, base::Seconds(2.5));
}

TEST(Completeness, AnImagesPoseIsLessThanHalfAPeriodAway) {
  EXPECT_EQ(CompletenessOf(Images(0, 9), Poses(0, 9, 0.049), {}).with_pose, 10);
  EXPECT_EQ(CompletenessOf(Images(0, 9), Poses(0, 9, -0.049), {}).with_pose, 10);
  // Two poses for every second image are no ten images.
  std::vector<base::StampedPose> estimate;
  for (int i = 0; i < 10; i += 2) {
    estimate.push_back({At(0.1 * i - 0.01), {}});
    estimate.push_back({At(0.1 * i + 0.01), {}});
  }
  EXPECT_EQ(CompletenessOf(Images(0, 9), estimate, {}).with_pose, 5);
  // A pose for every millisecond are not more than there are images.
  estimate.clear();
  for (int i = 0; i < 1000; ++i) estimate.push_back({At(1e-3 * i), {}});
  const Completeness often = CompletenessOf(Images(0, 9), estimate, {});
  EXPECT_EQ(often.with_pose, 10);
  EXPECT_EQ(often.images, 10);
}

TEST(Completeness, NothingIsNothing) {
  const Completeness none = CompletenessOf(Images(0, 9), {}, {});
  EXPECT_EQ(none.share(), 0);
  EXPECT_EQ(none.until_first, base::Seconds(0.9));
  EXPECT_EQ(none.longest_gap.ns, 0);
  EXPECT_EQ(CompletenessOf({}, Poses(0, 9), {}).share(), 0);
  EXPECT_EQ(CompletenessOf(Images(0, 0), Poses(0, 0), {}).share(), 1);
}

}  // namespace
}  // namespace alula::scenarios::trajectory
