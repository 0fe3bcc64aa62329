#include "base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "base/hash.h"

namespace alula::base {
namespace {

TEST(Philox, MatchesThePublishedVectors) {
  // Random123's kat_vectors, philox4x32 10: the known answers of Salmon et al.
  using Block = std::array<std::uint32_t, 4>;
  EXPECT_EQ(Philox4x32({0, 0, 0, 0}, {0, 0}), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(Philox4x32({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0xffffffff, 0xffffffff}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(Philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(RandomStream, IsTheSameForTheSameSeedAndName) {
  RandomStream a(7, "vehicle0/imu.gyro"), b(7, "vehicle0/imu.gyro"), other_name(7, "vehicle0/imu.accel"),
      other_seed(8, "vehicle0/imu.gyro");
  int equal_name = 0, equal_seed = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint64_t bits = a.Bits();
    EXPECT_EQ(bits, b.Bits());
    equal_name += bits == other_name.Bits();
    equal_seed += bits == other_seed.Bits();
  }
  EXPECT_EQ(equal_name + equal_seed, 0);
}

TEST(RandomStream, GaussianHasTheMomentsOfTheNormalDistribution) {
  RandomStream random(1, "moments");
  constexpr int kDraws = 400'000;
  double m1 = 0, m2 = 0, m3 = 0, m4 = 0, lagged = 0, last = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.Gaussian();
    m1 += x;
    m2 += x * x;
    m3 += x * x * x;
    m4 += x * x * x * x;
    lagged += x * last;
    last = x;
  }
  const double root_n = std::sqrt(static_cast<double>(kDraws));
  // Four standard deviations of each sample moment: their variances are 1, 2, 15 and 96.
  EXPECT_NEAR(m1 / kDraws, 0, 4 / root_n);
  EXPECT_NEAR(m2 / kDraws, 1, 4 * std::sqrt(2.0) / root_n);
  EXPECT_NEAR(m3 / kDraws, 0, 4 * std::sqrt(15.0) / root_n);
  EXPECT_NEAR(m4 / kDraws, 3, 4 * std::sqrt(96.0) / root_n);
  EXPECT_NEAR(lagged / kDraws, 0, 4 / root_n);
}

TEST(RandomStream, UniformFillsItsIntervalEvenly) {
  RandomStream random(1, "uniform");
  constexpr int kBins = 64, kDraws = 64'000;
  std::vector<int> counts(kBins);
  for (int i = 0; i < kDraws; ++i) {
    const double u = random.Uniform();
    ASSERT_GE(u, 0.0);
    ASSERT_LT(u, 1.0);
    ++counts[static_cast<std::size_t>(u * kBins)];
  }
  double chi2 = 0;
  constexpr double kExpected = static_cast<double>(kDraws) / kBins;
  for (const int count : counts) chi2 += (count - kExpected) * (count - kExpected) / kExpected;
  EXPECT_LT(chi2, 110.0);  // 63 degrees of freedom: 99.98 %
  EXPECT_GT(chi2, 30.0);   // 0.01 %
}

TEST(RandomStream, IndexIsUnbiasedAndStaysInside) {
  RandomStream random(1, "index");
  std::vector<int> counts(6);
  for (int i = 0; i < 60'000; ++i) ++counts.at(static_cast<std::size_t>(random.Index(6)));
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 4 * std::sqrt(10'000 * 5.0 / 6.0));
  EXPECT_EQ(random.Index(1), 0u);
}

TEST(Hash, FollowsFnv1a) {
  EXPECT_EQ(HashName(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(HashName("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(HashName("foobar"), 0x85944171f73967e8ULL);
}

TEST(Hash, RollingHashSeesEveryBitOrderAndLength) {
  std::set<std::string> seen;
  const auto add = [&](const auto&... values) {
    RollingHash hash;
    (hash.Add(values), ...);
    return seen.insert(hash.Hex()).second;
  };
  EXPECT_TRUE(add());
  EXPECT_TRUE(add(0.0));
  EXPECT_TRUE(add(0.0, 0.0));
  EXPECT_TRUE(add(1.0, 2.0));
  EXPECT_TRUE(add(2.0, 1.0));
  EXPECT_TRUE(add(std::nextafter(2.0, 3.0), 1.0));
  EXPECT_TRUE(add(std::string_view("ab"), std::string_view("c")));
  EXPECT_TRUE(add(std::string_view("a"), std::string_view("bc")));
  EXPECT_FALSE(add(-0.0));
  EXPECT_TRUE(add(std::nan("1")));
  EXPECT_FALSE(add(-std::nan("2")));
}

}  // namespace
}  // namespace alula::base
