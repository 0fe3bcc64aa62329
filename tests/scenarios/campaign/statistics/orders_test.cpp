#include "scenarios/campaign/statistics/orders.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"

namespace alula::scenarios::statistics {
namespace {

using Points = std::vector<std::vector<double>>;

void ExpectOnePointPerStratum(const Points& points, std::size_t dimension) {
  std::set<std::size_t> strata;
  for (const std::vector<double>& point : points) {
    strata.insert(static_cast<std::size_t>(point[dimension] * static_cast<double>(points.size())));
  }
  EXPECT_EQ(strata.size(), points.size()) << "dimension " << dimension;
}

void ExpectInside(const Points& points) {
  for (const std::vector<double>& point : points) {
    for (const double x : point) {
      ASSERT_GT(x, 0.0);
      ASSERT_LT(x, 1.0);
    }
  }
}

TEST(LatinHypercube, OnePointPerStratum) {
  for (const std::int64_t runs : {1, 7, 100, 1000}) {
    const Points points = LatinHypercube(runs, 5, 3);
    ASSERT_EQ(points.size(), static_cast<std::size_t>(runs));
    ExpectInside(points);
    for (std::size_t k = 0; k < 5; ++k) ExpectOnePointPerStratum(points, k);
  }
}

TEST(LatinHypercube, SeedsDifferAndRepeat) {
  EXPECT_EQ(LatinHypercube(20, 3, 1), LatinHypercube(20, 3, 1));
  EXPECT_NE(LatinHypercube(20, 3, 1), LatinHypercube(20, 3, 2));
}

// 2^m points from 0 on: one in each of the 2^m dyadic intervals of every dimension, and in the first two dimensions
// one in each box of area 2^-m of whatever shape (a (0, m, 2)-net). The digital shift keeps both.
TEST(SobolPoints, DyadicBoxesAreBalanced) {
  constexpr int kPowers = 8;
  const Points points = SobolPoints(0, 1 << kPowers, 40, 11);
  ExpectInside(points);
  for (std::size_t k = 0; k < 40; ++k) ExpectOnePointPerStratum(points, k);
  for (int m = 0; m <= kPowers; ++m) {
    std::set<std::pair<int, int>> boxes;
    for (const std::vector<double>& point : points) {
      boxes.insert({static_cast<int>(point[0] * (1 << m)), static_cast<int>(point[1] * (1 << (kPowers - m)))});
    }
    EXPECT_EQ(boxes.size(), points.size()) << m;
  }
}

TEST(SobolPoints, APointDoesNotDependOnHowManyAreAsked) {
  const Points all = SobolPoints(0, 100, 4, 5);
  for (const std::int64_t first : {0, 1, 2, 33, 99}) {
    const Points some = SobolPoints(first, 100 - first, 4, 5);
    EXPECT_TRUE(std::equal(some.begin(), some.end(), all.begin() + first)) << first;
  }
  EXPECT_NE(all, SobolPoints(0, 100, 4, 6));
}

TEST(SobolPoints, Dimensions) {
  EXPECT_EQ(SobolPoints(0, 2, kMaxSobolDimensions, 1).front().size(), kMaxSobolDimensions);
  EXPECT_THROW(SobolPoints(0, 2, kMaxSobolDimensions + 1, 1), base::InputError);
  EXPECT_EQ(SobolPoints(0, 3, 0, 1).size(), 3u);
}

}  // namespace
}  // namespace alula::scenarios::statistics
