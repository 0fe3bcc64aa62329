// What lens and sensor do to a picture, against closed forms.
#include "render/image_sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "base/config.h"
#include "base/error.h"
#include "base/random.h"
#include "render/internal/sensor_kernel.h"
#include "stack/interface/camera_model.h"

namespace alula::render {
namespace {

stack::CameraIntrinsics Camera() { return {320, 240, 200.0, 200.0, 159.5, 119.5, {}}; }

Picture Flat(int value, int channels = 1) {
  return {
      320, 240, channels,
      std::vector<std::uint8_t>(320UL * 240 * static_cast<std::size_t>(channels), static_cast<std::uint8_t>(value))};
}

/// Every value in turn.
Picture Ramp(int channels) {
  Picture picture = Flat(0, channels);
  for (std::size_t i = 0; i < picture.bytes.size(); ++i) picture.bytes[i] = static_cast<std::uint8_t>(i * 7);
  return picture;
}

SensorEffects Silent() {
  SensorEffects effects;
  effects.noise = {0.0, 0.0};
  return effects;
}

double At(const Picture& picture, int u, int v) { return picture.bytes[static_cast<std::size_t>(v * 320 + u)]; }

struct Moments {
  double mean = 0, variance = 0;
};
template <typename Values>
Moments MomentsOf(const Values& values) {
  Moments m;
  const auto n = static_cast<double>(values.size());
  for (const auto value : values) m.mean += static_cast<double>(value) / n;
  for (const auto value : values)
    m.variance += (static_cast<double>(value) - m.mean) * (static_cast<double>(value) - m.mean) / n;
  return m;
}

TEST(ImageSensor, WithNoiseAloneIsApplyPixelNoise) {
  for (const int channels : {1, 3}) {
    Picture a = Ramp(channels), b = a;
    ImageSensor({}, Camera(), channels, 3).Apply(a, 99);
    ApplyPixelNoise(b, 99, {});
    EXPECT_TRUE(a.bytes == b.bytes);
  }
}

TEST(ImageSensor, WithEverythingOffLeavesThePictureAlone) {
  Picture picture = Ramp(3);
  const std::array<GlareLight, 1> sun = {{{base::Vec3::UnitZ()}}};
  ImageSensor(Silent(), Camera(), 3, 3).Apply(picture, 1, {.gain = 4.0, .lights = sun});
  EXPECT_TRUE(picture.bytes == Ramp(3).bytes);
}

/// EMVA 1288: variance gain² read² + gain · shot · value. Five standard errors of 76,800 samples are 2.6 %; rounding's
/// share is taken into account.
TEST(ImageSensor, NoiseGrowsWithGain) {
  const SensorEffects effects;
  const ImageSensor sensor(effects, Camera(), 1, 1);
  for (const double gain : {1.0, 2.0, 8.0}) {
    Picture picture = Flat(120);
    sensor.Apply(picture, 5, {.gain = gain});
    const double expected = gain * gain * 0.8 * 0.8 + gain * 0.012 * 120;
    EXPECT_NEAR(MomentsOf(picture.bytes).variance / expected, 1.0, 0.03) << gain;
  }
}

TEST(ImageSensor, VignettesByTheLawOfCos4) {
  SensorEffects effects = Silent();
  effects.vignetting = 0.6;
  Picture picture = Flat(250);
  ImageSensor(effects, Camera(), 1, 1).Apply(picture, 1);
  const double corner2 = 159.5 * 159.5 + 119.5 * 119.5;
  const double tangent2 = 1.0 / std::sqrt(0.4) - 1.0;  // so that cos⁴ is 0.4 in the corner
  for (int v = 0; v < 240; v += 17) {
    for (int u = 0; u < 320; u += 13) {
      const double r2 = ((u - 159.5) * (u - 159.5) + (v - 119.5) * (v - 119.5)) / corner2;
      const double theta = std::atan(std::sqrt(tangent2 * r2));
      EXPECT_NEAR(At(picture, u, v), 250.0 * std::pow(std::cos(theta), 4), 0.51);  // rounding
    }
  }
  EXPECT_EQ(At(picture, 0, 0), 100);
}

TEST(ImageSensor, PatternIsThePixelsOwn) {
  SensorEffects effects = Silent();
  effects.fixed_pattern = {3.0, 0.04};
  const ImageSensor sensor(effects, Camera(), 1, 1), other(effects, Camera(), 1, 2);
  Picture bright = Flat(150), again = Flat(150), elsewhere = Flat(150), dark = Flat(40), gained = Flat(40);
  sensor.Apply(bright, 1);
  sensor.Apply(again, 2);
  other.Apply(elsewhere, 1);
  sensor.Apply(dark, 1);
  sensor.Apply(gained, 1, {.gain = 3.0});
  EXPECT_TRUE(bright.bytes == again.bytes);
  const Moments b = MomentsOf(bright.bytes), d = MomentsOf(dark.bytes), g = MomentsOf(gained.bytes);
  constexpr double kRounding = 1.0 / 12.0, kShare = 0.03;  // five standard errors of the variance are 2.6 %
  EXPECT_NEAR(b.mean, 150, 5 * std::sqrt(b.variance / 76800.0));
  EXPECT_NEAR(b.variance, 9.0 + 36.0 + kRounding, kShare * b.variance);
  EXPECT_NEAR(d.variance, 9.0 + 1.6 * 1.6 + kRounding, kShare * d.variance);
  EXPECT_NEAR(g.variance, 81.0 + 1.6 * 1.6 + kRounding, kShare * g.variance);  // the dark offset is amplified
  double product = 0;
  for (std::size_t i = 0; i < bright.bytes.size(); ++i) {
    product += (bright.bytes[i] - 150.0) * (elsewhere.bytes[i] - 150.0) / 76800.0;
  }
  EXPECT_LT(std::abs(product / b.variance), 5.0 / std::sqrt(76800.0));
}

TEST(ImageSensor, GammaBendsTheCurve) {
  SensorEffects effects = Silent();
  effects.gamma = 2.2;
  Picture picture = Ramp(1);
  const Picture before = picture;
  ImageSensor(effects, Camera(), 1, 1).Apply(picture, 1);
  for (std::size_t i = 0; i < 256; ++i) {
    EXPECT_EQ(picture.bytes[i], std::floor(255.0 * std::pow(before.bytes[i] / 255.0, 1.0 / 2.2) + 0.5));
  }
}

TEST(ImageSensor, FewBitsAreFewLevels) {
  for (const int bits : {1, 4, 6}) {
    SensorEffects effects = Silent();
    effects.bits = bits;
    Picture picture = Ramp(1);
    const Picture before = picture;
    ImageSensor(effects, Camera(), 1, 1).Apply(picture, 1);
    const std::set<std::uint8_t> levels(picture.bytes.begin(), picture.bytes.end());
    EXPECT_EQ(levels.size(), 1UL << bits);
    EXPECT_EQ(*levels.begin(), 0);
    EXPECT_EQ(*levels.rbegin(), 255);
    for (std::size_t i = 0; i < 256; ++i) {  // the nearest level
      EXPECT_LE(std::abs(picture.bytes[i] - before.bytes[i]), std::ceil(127.5 / ((1 << bits) - 1)));
    }
  }
}

TEST(ImageSensor, MudHidesTheShareStated) {
  for (const double share : {0.05, 0.3, 0.9}) {
    SensorEffects effects = Silent();
    effects.dirt.obscured = share;
    Picture picture = Flat(200);
    ImageSensor(effects, Camera(), 1, 7).Apply(picture, 1);
    const auto hidden = std::count_if(picture.bytes.begin(), picture.bytes.end(), [](int b) { return b < 100; });
    EXPECT_NEAR(static_cast<double>(hidden) / 76800.0, share, 0.005) << share;
    EXPECT_LT(*std::min_element(picture.bytes.begin(), picture.bytes.end()), 5);
    EXPECT_GT(*std::max_element(picture.bytes.begin(), picture.bytes.end()), 195);
  }
  SensorEffects blind = Silent();
  blind.dirt.obscured = 1.0;
  Picture picture = Flat(200);
  ImageSensor(blind, Camera(), 1, 7).Apply(picture, 1);
  EXPECT_EQ(*std::max_element(picture.bytes.begin(), picture.bytes.end()), 0);
}

/// A smudge takes contrast, not light: stripes of 40 and 160 come closer to their mean.
TEST(ImageSensor, SmudgesScatterWhatTheyTake) {
  SensorEffects effects = Silent();
  effects.dirt.smudged = 0.4;
  effects.dirt.smudge_loss = 0.5;
  const ImageSensor sensor(effects, Camera(), 1, 3);
  Picture stripes = Flat(40), flat = Flat(100);
  for (std::size_t i = 0; i < stripes.bytes.size(); ++i) {
    if (i % 2 == 1) stripes.bytes[i] = 160;
  }
  sensor.Apply(stripes, 1);
  sensor.Apply(flat, 1);
  int dimmed = 0;
  double least = 120;
  for (std::size_t i = 0; i + 1 < stripes.bytes.size(); i += 2) {
    const double contrast = stripes.bytes[i + 1] - stripes.bytes[i];
    dimmed += contrast < 119.5 ? 2 : 0;
    least = std::min(least, contrast);
    EXPECT_NEAR(0.5 * (stripes.bytes[i] + stripes.bytes[i + 1]), 100, 3);  // a pixel further the smudge is another
    EXPECT_NEAR(flat.bytes[i], 100, 1.01);                                 // rounding
  }
  EXPECT_NEAR(dimmed / 76800.0, 0.4, 0.05);  // the rim's first hundredth cannot be seen in whole grey levels
  EXPECT_NEAR(least, 60, 10);
}

TEST(ImageSensor, GlareFallsWithTheSquareOfTheAngle) {
  SensorEffects effects = Silent();
  effects.glare = {.veil = 12.0, .ghosts = 0.0};
  const ImageSensor sensor(effects, Camera(), 1, 1);
  const std::array<GlareLight, 1> sun = {{{base::Vec3(-0.3, 0.1, 1).normalized()}}};
  for (const double brightness : {1.0, 2.0}) {
    Picture picture = Flat(20);
    sensor.Apply(picture, 1, {.brightness = brightness, .lights = sun});
    for (int v = 0; v < 240; v += 19) {
      for (int u = 0; u < 320; u += 23) {
        const double chord = (stack::Ray(Camera(), {u, v}) - sun[0].to_light_C).norm() * 180 / M_PI;  // for the angle
        if (chord < 8.0) continue;
        const double veil = brightness * 12.0 * 100.0 / (chord * chord);
        // Between nodes 2.3° apart the curve is a chord of its own: 2 · 2.3²/8 · 6/θ² too high at the worst.
        EXPECT_NEAR(At(picture, u, v), std::min(20.0 + veil, 255.0), 8.0 / (chord * chord) * veil + 0.51) << chord;
      }
    }
    EXPECT_EQ(At(picture, 100, 140), 255);  // the sun itself
  }
  // The hood: beyond 60° nothing; 3° before it more than half.
  Picture shaded = Flat(20), grazed = Flat(20);
  const std::array<GlareLight, 1> outside = {{{base::Vec3(std::sin(1.06), 0, std::cos(1.06))}}};
  const std::array<GlareLight, 1> edge = {{{base::Vec3(std::sin(0.995), 0, std::cos(0.995))}}};
  sensor.Apply(shaded, 1, {.lights = outside});
  EXPECT_TRUE(shaded.bytes == Flat(20).bytes);
  sensor.Apply(grazed, 1, {.lights = edge});
  const double angle = (0.995 - std::atan(159.5 / 200)) * 180 / M_PI;
  const double share = (M_PI / 3 - 0.995) * 180 / M_PI / 5.0;
  EXPECT_NEAR(At(grazed, 319, 120), 20 + share * 12.0 * 100 / (angle * angle), 0.7);
}

/// The brightest ghost sits at −0.35 times the sun's place, seen from the middle.
TEST(ImageSensor, GhostsLieOnTheLineThroughTheMiddle) {
  SensorEffects effects = Silent();
  effects.glare = {.veil = 20.0, .ghosts = 2.0};
  SensorEffects without = effects;
  without.glare.ghosts = 0.0;
  const std::array<GlareLight, 1> sun = {{{base::Vec3(-0.5, -0.3, 1).normalized()}}};
  Picture a = Flat(0), b = Flat(0);
  ImageSensor(effects, Camera(), 1, 1).Apply(a, 1, {.lights = sun});
  ImageSensor(without, Camera(), 1, 1).Apply(b, 1, {.lights = sun});
  const int u = static_cast<int>(std::lround(159.5 + 0.35 * 100)), v = static_cast<int>(std::lround(119.5 + 0.35 * 60));
  EXPECT_NEAR(At(a, u, v) - At(b, u, v), 40, 1);
  EXPECT_EQ(At(a, 60, 200), At(b, 60, 200));  // off the line
}

TEST(ImageSensor, EveryInstructionSetGivesTheSameBytes) {
#if defined(__x86_64__)
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "no AVX2 here";
  constexpr std::size_t kCount = 3007;
  base::RandomStream random(1, "kernels");
  std::vector<std::uint8_t> pixels, tone(255 * internal::kToneSteps + 1);
  std::vector<std::uint16_t> transmission;
  std::vector<std::int16_t> response, dark;
  std::vector<float> added;
  for (std::size_t i = 0; i < kCount; ++i) {
    pixels.push_back(static_cast<std::uint8_t>(random.Index(256)));
    transmission.push_back(static_cast<std::uint16_t>(random.Index(32769)));
    response.push_back(static_cast<std::int16_t>(random.Uniform(-2000, 2000)));
    dark.push_back(static_cast<std::int16_t>(random.Uniform(-2000, 2000)));
    added.push_back(static_cast<float>(random.Uniform(0, 60)));
  }
  for (std::size_t i = 0; i < tone.size(); ++i) tone[i] = static_cast<std::uint8_t>(random.Index(256));
  std::set<std::vector<std::uint8_t>> results;
  for (int parts = 0; parts < 16; ++parts) {
    std::vector<std::uint8_t> a = pixels, b = pixels;
    internal::SensorJob job{.pixels = a.data(),
                            .count = kCount,
                            .first = 12345,
                            .key0 = 17,
                            .key1 = 23,
                            .read_variance = 0.5F,
                            .shot = 0.02F,
                            .transmission = (parts & 1) != 0 ? transmission.data() : nullptr,
                            .added = (parts & 2) != 0 ? added.data() : nullptr,
                            .response = (parts & 4) != 0 ? response.data() : nullptr,
                            .dark = (parts & 4) != 0 ? dark.data() : nullptr,
                            .dark_step = 1.0F / 256.0F,
                            .tone = (parts & 8) != 0 ? tone.data() : nullptr};
    internal::SenseBaseline(job);
    job.pixels = b.data();
    internal::SenseAvx2(job);
    EXPECT_TRUE(a == b) << parts;
    results.insert(a);
  }
  EXPECT_EQ(results.size(), 16U);  // each part does something
#else
  GTEST_SKIP() << "one kernel on this machine";
#endif
}

TEST(ImageSensor, RefusesTheImpossible) {
  SensorEffects effects;
  effects.bits = 9;
  EXPECT_THROW(ImageSensor(effects, Camera(), 1, 1), base::InputError);
  effects = {};
  effects.gamma = 0;
  EXPECT_THROW(ImageSensor(effects, Camera(), 1, 1), base::InputError);
  effects = {};
  effects.vignetting = 1;
  EXPECT_THROW(ImageSensor(effects, Camera(), 1, 1), base::InputError);
  Picture large{321, 240, 1, std::vector<std::uint8_t>(321UL * 240)};
  EXPECT_THROW(ImageSensor({}, Camera(), 1, 1).Apply(large, 1), base::FaultError);
}

TEST(ImageSensor, IsReadFromAFile) {
  const auto document = base::YamlDocument::Parse("vignetting: 0.3\ndirt:\n  smudged: 0.1\nglare:\n  veil: 20\n", "x");
  const auto effects = base::ReadConfig<SensorEffects>(document, 1);
  EXPECT_EQ(effects.vignetting, 0.3);
  EXPECT_EQ(effects.dirt.smudged, 0.1);
  EXPECT_EQ(effects.glare.veil, 20);
  EXPECT_THROW(base::ReadConfig<SensorEffects>(base::YamlDocument::Parse("bits: 9\n", "x"), 1), base::InputError);
}

}  // namespace
}  // namespace alula::render
