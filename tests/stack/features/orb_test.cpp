#include "stack/features/orb.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/features2d.hpp>
#include <set>

#include "base/error.h"
#include "base/random.h"
#include "stack/features/internal/octave.h"
#include "stack/features/internal/orb_kernels.h"
#include "stack/features/internal/quadtree.h"
#include "stack/features/keypoint_grid.h"

namespace alula::stack::features::test {
namespace {

using base::Vec2;

constexpr int kWidth = 752, kHeight = 480;

/// A wall with spots of all sizes (value noise, Perlin's octaves): a picture that can be drawn turned, shifted and from
/// nearer without resampling. The left of it may be fainter.
struct Wall {
  std::uint64_t seed = 0;
  double contrast_left = 1.0;

  static double Hash(std::uint64_t seed, int octave, long i, long j) {
    const auto block = base::Philox4x32(
        {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(octave), 7},
        {static_cast<std::uint32_t>(seed), 1});
    return block[0] / 4294967296.0 - 0.5;
  }

  double Grey(const Vec2& p) const {
    double sum = 0.0;
    double size = 48.0;  // px between nodes
    for (int octave = 0; octave < 4; ++octave, size *= 0.5) {
      const double x = p.x() / size, y = p.y() / size;
      const long i = std::lround(std::floor(x)), j = std::lround(std::floor(y));
      const auto ease = [](double t) { return t * t * (3 - 2 * t); };
      const double u = ease(x - static_cast<double>(i)), v = ease(y - static_cast<double>(j));
      sum += (1 - v) * ((1 - u) * Hash(seed, octave, i, j) + u * Hash(seed, octave, i + 1, j)) +
             v * ((1 - u) * Hash(seed, octave, i, j + 1) + u * Hash(seed, octave, i + 1, j + 1));
    }
    return std::clamp(128 + (p.x() < 0 ? contrast_left : 1.0) * 110 * std::tanh(5 * sum), 0.0, 255.0);
  }
};

/// Where a camera that is turned by `angle`, moved by `shift` and `scale` times nearer sees a place of the wall.
struct View {
  double angle = 0.0, scale = 1.0;
  Vec2 shift = Vec2::Zero();

  Vec2 Centre() const { return {0.5 * (kWidth - 1), 0.5 * (kHeight - 1)}; }
  Vec2 PixelOf(const Vec2& place) const { return scale * (Eigen::Rotation2Dd(angle) * place) + shift + Centre(); }
  Vec2 PlaceOf(const Vec2& pixel) const {
    return Eigen::Rotation2Dd(-angle) * Vec2((pixel - shift - Centre()) / scale);
  }
};

Image Draw(const Wall& wall, const View& view, double noise = 1.0) {
  base::RandomStream random(5, "test/pixels");
  auto bytes = std::make_shared<std::vector<std::uint8_t>>();
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      const double grey = wall.Grey(view.PlaceOf(Vec2(u, v))) + noise * random.Gaussian();
      bytes->push_back(static_cast<std::uint8_t>(std::clamp(std::lround(grey), 0L, 255L)));
    }
  }
  Image image;
  image.width = image.stride = kWidth;
  image.height = kHeight;
  image.bytes = std::move(bytes);
  return image;
}

std::vector<Descriptor> DescriptorsOf(const std::vector<Keypoint>& keypoints) {
  std::vector<Descriptor> all;
  for (const Keypoint& k : keypoints) all.push_back(k.descriptor);
  return all;
}

double Median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values.empty() ? 1e9 : values[values.size() / 2];
}

TEST(OrbKernels, OfBothInstructionSetsGiveTheSameBits) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2 here";
  const internal::OrbKernels slow = internal::ScalarOrbKernels(), fast = internal::Avx2OrbKernels();
  base::RandomStream random(1, "test/kernels");
  constexpr int kSide = 101, kRoom = kSide + 64;
  for (int round = 0; round < 30; ++round) {
    // Smooth in part, so that all branches are taken.
    internal::Octave image(kSide, kSide);
    for (int i = 0; i < kRoom * (kSide + 1); ++i) {
      image.bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(
          (i / 7 + round) % 3 == 0 ? random.Index(256) : 100 + random.Index(1 + 3 * static_cast<unsigned>(round)));
    }
    const std::uint8_t* row = image.Row(50) + 20;
    std::array<std::vector<std::uint8_t>, 2> bytes;
    std::array<std::vector<std::uint32_t>, 2> bits;
    for (const bool second : {false, true}) {
      const internal::OrbKernels& k = second ? fast : slow;
      std::vector<std::uint8_t>& out = bytes[second];
      std::vector<std::uint8_t> line(200);
      const auto keep = [&](int count) { out.insert(out.end(), line.begin(), line.begin() + count); };
      k.corner_scores(row, image.stride, 61, 3 + round, line.data());
      keep(61);
      std::vector<std::uint16_t> scratch(200);
      k.smooth(row, image.stride, 61, scratch.data(), line.data());
      keep(61);
      k.blend_rows(row, row + image.stride, 2 * round, 61, line.data());
      keep(61);
      internal::ColumnBlend columns{3, {0, 1, 1, 2, 2, 3, 4, 5, 5, 6, 6, 7, 7, 8, 9, 10}, {}};
      for (int i = 0; i < 16; ++i)
        columns.weight[i] = static_cast<std::int8_t>(i % 2 == 0 ? 64 - 2 * round : 2 * round);
      k.blend_columns(row, &columns, 1, line.data());
      keep(8);
      bits[second].resize(3);
      k.peaks(row, image.stride, 61, bits[second].data());
      std::int32_t m10 = 0, m01 = 0;
      k.moments(image.Row(40) + 40, image.stride, &m10, &m01);
      Descriptor d{};
      const float angle = 0.2F * static_cast<float>(round);
      k.describe(image.Row(40) + 40, image.stride, std::cos(angle), std::sin(angle), internal::Pattern(), d.data());
      std::uint16_t distance = 0;
      const Descriptor other{77, 3, ~0ULL, 5};
      k.distances(d.data(), other.data(), 1, &distance);
      EXPECT_EQ(distance, HammingDistance(d, other));
      for (const std::int64_t value : {std::int64_t{m10}, std::int64_t{m01}, std::int64_t{distance}}) {
        for (int s = 0; s < 32; s += 8) out.push_back(static_cast<std::uint8_t>(value >> s));
      }
      for (const std::uint64_t word : d) {
        for (int s = 0; s < 64; s += 8) out.push_back(static_cast<std::uint8_t>(word >> s));
      }
    }
    EXPECT_EQ(bytes[0], bytes[1]) << round;
    bits[0].resize(2), bits[1].resize(2);
    EXPECT_EQ(bits[0], bits[1]) << round;
  }
#endif
}

TEST(OrbKernels, FindTheCornersThatOpenCvFinds) {
  const Image image = Draw(Wall{3}, {});
  const cv::Mat view(kHeight, kWidth, CV_8UC1, const_cast<std::uint8_t*>(image.Row(0)));
  std::vector<cv::KeyPoint> theirs;
  cv::FAST(view, theirs, 20, false);
  std::set<std::pair<int, int>> expected, found;
  for (const cv::KeyPoint& k : theirs) {
    if (k.pt.x >= 20 && k.pt.x < 700) expected.emplace(static_cast<int>(k.pt.y), static_cast<int>(k.pt.x));
  }
  const internal::Octave octave = internal::FirstOctave(image);
  std::vector<std::uint8_t> scores(kWidth + 64);
  for (int v = 3; v < kHeight - 3; ++v) {
    internal::ScalarOrbKernels().corner_scores(octave.Row(v) + 20, octave.stride, 680, 20, scores.data());
    for (int u = 0; u < 680; ++u) {
      if (scores[static_cast<std::size_t>(u)] > 0) found.emplace(v, u + 20);
    }
  }
  EXPECT_GT(found.size(), 500U);
  EXPECT_EQ(found, expected);
}

TEST(Orb, PatternHasDistinctTestsInsideTheDisc) {
  const internal::BriefPattern& p = internal::Pattern();
  std::set<std::array<float, 4>> tests;
  for (int i = 0; i < 256; ++i) {
    EXPECT_LE(std::hypot(p.ax[i], p.ay[i]), internal::kPatchRadius);
    EXPECT_LE(std::hypot(p.bx[i], p.by[i]), internal::kPatchRadius);
    tests.insert({p.ax[i], p.ay[i], p.bx[i], p.by[i]});
  }
  EXPECT_EQ(tests.size(), 256U);
}

TEST(Orb, BitsSayMuchAndDifferentThings) {
  std::vector<double> mean(256, 0.0);
  double pairs = 0.0;
  std::vector<Descriptor> all;
  for (const std::uint64_t seed : {11ULL, 12ULL, 13ULL}) {
    const std::vector<Descriptor> some = DescriptorsOf(DetectOrb(Draw(Wall{seed}, {}), {}));
    all.insert(all.end(), some.begin(), some.end());
  }
  for (const Descriptor& d : all) {
    for (std::size_t i = 0; i < 256; ++i) mean[i] += static_cast<double>(d[i / 64] >> (i % 64) & 1U);
  }
  for (double& m : mean) m /= static_cast<double>(all.size());
  for (std::size_t i = 0; i + 1 < all.size(); ++i) pairs += HammingDistance(all[i], all[(i + 700) % all.size()]);
  std::vector<double> bias;
  for (const double m : mean) bias.push_back(std::abs(m - 0.5));
  EXPECT_LT(Median(bias), 0.15);                                        // ½: a bit tells most
  EXPECT_NEAR(pairs / static_cast<double>(all.size() - 1), 128.0, 12);  // unrelated corners
}

TEST(Orb, DescriptorsStayWhenTheViewTurns) {
  const Wall wall{4};
  const Image upright = Draw(wall, {});
  const std::vector<Keypoint> corners = DetectOrb(upright, {.keypoints = 300, .levels = 1});
  for (const double angle : {0.0, 0.4, 1.7, -2.6, std::numbers::pi}) {
    const View view{angle, 1.0, {7.3, -4.6}};
    const Image turned = Draw(wall, view);
    std::vector<Vec2> pixels;
    for (const Keypoint& k : corners) pixels.push_back(view.PixelOf(View{}.PlaceOf(k.pixel)));
    const auto seen = DescribeOrb(turned, pixels);
    std::vector<double> distances, turns;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      if (!seen[i]) continue;
      distances.push_back(HammingDistance(seen[i]->descriptor, corners[i].descriptor));
      turns.push_back(std::abs(std::remainder(seen[i]->angle - corners[i].angle - angle, 2 * std::numbers::pi)));
    }
    ASSERT_GT(distances.size(), 60U);
    EXPECT_LT(Median(distances), 26) << angle;  // unrelated: 128
    EXPECT_LT(Median(turns), 0.06) << angle;
  }
}

TEST(Orb, FindsTheSameCornersFromNearerAndTurned) {
  const Wall wall{6};
  const std::vector<Keypoint> a = DetectOrb(Draw(wall, {}), {});
  const View view{0.6, 1.35, {10.4, -8.7}};
  const std::vector<Keypoint> b = DetectOrb(Draw(wall, view), {});
  std::vector<double> errors;
  int right = 0;
  const auto matches = MatchDescriptors(DescriptorsOf(a), DescriptorsOf(b), {});
  for (const DescriptorMatch& m : matches) {
    const Keypoint &ka = a[static_cast<std::size_t>(m.a)], &kb = b[static_cast<std::size_t>(m.b)];
    const double error = (view.PixelOf(View{}.PlaceOf(ka.pixel)) - kb.pixel).norm();
    const double scale = OctaveScale({}, kb.octave);
    if (error < 3 * scale) {
      ++right;
      errors.push_back(error / scale);
    }
  }
  EXPECT_GT(right, 60);
  EXPECT_GT(right, 0.85 * static_cast<double>(matches.size()));
  EXPECT_LT(Median(errors), 0.45);
}

/// Median distance of keypoints from those of the picture before it was shifted by a fraction of a pixel.
double ShiftError(bool sub_pixel) {
  const Wall wall{7};
  const OrbConfig config{.keypoints = 5000, .levels = 1, .sub_pixel = sub_pixel};
  const std::vector<Keypoint> a = DetectOrb(Draw(wall, {}, 0.5), config);
  const Vec2 shift(0.5, 0.37);
  const std::vector<Keypoint> b = DetectOrb(Draw(wall, {0.0, 1.0, shift}, 0.5), config);
  std::vector<double> errors;
  for (const Keypoint& k : a) {
    double nearest = 2.0;
    for (const Keypoint& other : b) nearest = std::min(nearest, (other.pixel - k.pixel - shift).norm());
    if (nearest < 2.0) errors.push_back(nearest);
  }
  return Median(errors);
}

TEST(Orb, PlacesAreFinerThanPixels) {
  const double whole = ShiftError(false), fine = ShiftError(true);
  std::printf("median error of a shift by half a pixel: %.3f px, whole pixels %.3f\n", fine, whole);
  EXPECT_LT(fine, 0.65 * whole);
}

/// 1 / (1 + coefficient of variation) of the counts in 10 × 8 cells: 1 where all hold as many.
double Uniformity(const std::vector<Vec2>& pixels) {
  std::vector<double> count(80, 0.0);
  for (const Vec2& p : pixels) {
    ++count[static_cast<std::size_t>(std::min(7, static_cast<int>(8 * p.y() / kHeight)) * 10 +
                                     std::min(9, static_cast<int>(10 * p.x() / kWidth)))];
  }
  const double mean = static_cast<double>(pixels.size()) / 80;
  double variance = 0.0;
  for (const double c : count) variance += (c - mean) * (c - mean) / 80;
  return mean > 0 ? 1 / (1 + std::sqrt(variance) / mean) : 0.0;
}

TEST(Orb, IsMoreUniformThanPlainOrbAndFindsMoreOnAFaintWall) {
  for (const double contrast : {1.0, 0.12}) {
    const Image image = Draw(Wall{8, contrast}, {});
    std::vector<Vec2> ours, theirs;
    for (const Keypoint& k : DetectOrb(image, {})) ours.push_back(k.pixel);
    std::vector<cv::KeyPoint> plain;
    cv::ORB::create(500)->detect(cv::Mat(kHeight, kWidth, CV_8UC1, const_cast<std::uint8_t*>(image.Row(0))), plain);
    for (const cv::KeyPoint& k : plain) theirs.emplace_back(k.pt.x, k.pt.y);
    std::printf("contrast %.2f: %zu keypoints, uniformity %.3f; cv::ORB %zu, %.3f\n", contrast, ours.size(),
                Uniformity(ours), theirs.size(), Uniformity(theirs));
    EXPECT_GE(ours.size(), theirs.size() * 98 / 100);
    EXPECT_LE(ours.size(), 500U);
    // P1's figure, where there is something to gain.
    EXPECT_GT(Uniformity(ours), (contrast < 1.0 ? 1.2436 : 1.0) * Uniformity(theirs));
  }
}

TEST(Orb, SaliencyChoosesOtherCorners) {
  const Image image = Draw(Wall{9}, {});
  const std::vector<Keypoint> by_score = DetectOrb(image, {}),
                              by_saliency = DetectOrb(image, {.ranking = OrbRanking::kSaliency});
  EXPECT_NE(DescriptorsOf(by_score), DescriptorsOf(by_saliency));
  double score = 0, saliency = 0;
  for (const Keypoint& k : by_score) score = std::max(score, k.response);
  for (const Keypoint& k : by_saliency) saliency = std::max(saliency, k.response);
  EXPECT_LE(score, 255);
  EXPECT_GT(saliency, 255);  // a sum over 16 pixels
}

TEST(Orb, RefusesColourAndSurvivesSmallAndFlatImages) {
  Image image;
  image.width = image.stride = 60;
  image.height = 45;
  image.bytes = std::make_shared<std::vector<std::uint8_t>>(60 * 45, std::uint8_t{90});
  EXPECT_TRUE(DetectOrb(image, {}).empty());
  const auto described = DescribeOrb(image, std::vector<Vec2>{{30, 22}, {5, 22}});
  EXPECT_TRUE(described[0].has_value());
  EXPECT_FALSE(described[1].has_value());
  image.width = image.height = image.stride = 20;
  EXPECT_TRUE(DetectOrb(image, {}).empty());
  image.format = PixelFormat::kRgb8;
  EXPECT_THROW(DetectOrb(image, {}), base::InputError);
}

TEST(Quadtree, KeepsTheStrongestOfEachLeaf) {
  base::RandomStream random(2, "test/quadtree");
  std::vector<internal::LevelCorner> corners;
  for (int i = 0; i < 900; ++i) {  // nine tenths in one corner of the image
    const int reach = i % 10 == 0 ? 320 : 60;
    corners.push_back({static_cast<int>(random.Index(2 * static_cast<unsigned>(reach))),
                       static_cast<int>(random.Index(static_cast<unsigned>(reach))),
                       static_cast<float>(random.Uniform())});
  }
  const auto kept = internal::Distribute(corners, 640, 320, 64, 2);
  EXPECT_LE(kept.size(), 64U);
  EXPECT_GE(kept.size(), 60U);
  // Enough leaves for one each 80 px: no square of 160 px that has a corner is left without.
  std::set<std::pair<int, int>> all, held;
  for (const auto& c : corners) all.emplace(c.x / 160, c.y / 160);
  for (const auto& c : kept) held.emplace(c.x / 160, c.y / 160);
  EXPECT_EQ(all, held);
  const auto strongest = std::max_element(corners.begin(), corners.end(),
                                          [](const auto& a, const auto& b) { return a.response < b.response; });
  EXPECT_TRUE(std::any_of(kept.begin(), kept.end(), [&](const auto& c) { return c.response == strongest->response; }));
  std::set<std::pair<int, int>> places;
  for (const auto& c : corners) places.emplace(c.x, c.y);
  EXPECT_EQ(internal::Distribute(corners, 640, 320, 5000, 1).size(), places.size());
}

TEST(KeypointGrid, FindsWhatBruteForceFinds) {
  base::RandomStream random(3, "test/grid");
  std::vector<Vec2> pixels;
  for (int i = 0; i < 400; ++i) pixels.emplace_back(random.Uniform(-5, 645), random.Uniform(-5, 485));
  const KeypointGrid grid(pixels, 640, 480);
  for (int i = 0; i < 200; ++i) {
    const Vec2 at(random.Uniform(-40, 680), random.Uniform(-40, 520));
    const double radius = random.Uniform(1, 90);
    std::vector<int> found = grid.Around(at, radius), expected;
    for (std::size_t k = 0; k < pixels.size(); ++k) {
      if ((pixels[k] - at).norm() <= radius) expected.push_back(static_cast<int>(k));
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(MatchDescriptors, KeepsMutualAndUniqueNeighboursOnly) {
  base::RandomStream random(4, "test/match");
  std::vector<Descriptor> a(120), b;
  for (Descriptor& d : a) d = {random.Bits(), random.Bits(), random.Bits(), random.Bits()};
  for (const Descriptor& d : a) {  // the same with some bits changed, in reverse order
    Descriptor noisy = d;
    for (int k = 0; k < 20; ++k) noisy[random.Index(4)] ^= 1ULL << random.Index(64);
    b.insert(b.begin(), noisy);
  }
  b.push_back(b.front());  // a double: its original is no longer unique
  const auto matches = MatchDescriptors(a, b, {});
  ASSERT_EQ(matches.size(), 119U);
  for (const DescriptorMatch& m : matches) {
    EXPECT_EQ(m.a + m.b, 119);
    EXPECT_EQ(m.distance, HammingDistance(a[static_cast<std::size_t>(m.a)], b[static_cast<std::size_t>(m.b)]));
  }
  EXPECT_EQ(MatchDescriptors(a, b, {.ratio = 1.0}).size(), 120U);
  a.push_back(a[5]);  // two of a want one of b: it has but one
  EXPECT_EQ(MatchDescriptors(a, b, {}).size(), 119U);
  EXPECT_EQ(MatchDescriptors(a, b, {.mutual = false}).size(), 120U);
}

}  // namespace
}  // namespace alula::stack::features::test
