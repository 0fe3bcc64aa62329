// Magnetometer and Earth's field against their closed forms.
#include "sim/sensors/magnetometer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/magnetic_field.h"

namespace alula::sim {
namespace {

using base::Quat;
using base::Vec3;

MagnetometerConfig Ideal() {
  MagnetometerConfig c;
  c.noise = c.hard_iron_sigma = c.quantum = 0.0;
  return c;
}

constexpr double kRounding = 1e-19;  // T: a few ulp of 48 µT

TEST(MagneticField, ElementsGiveEastNorthUp) {
  const Vec3 zurich = FluxDensity({});
  EXPECT_NEAR(zurich.norm(), 48e-6, kRounding);
  EXPECT_NEAR(zurich.head<2>().norm(), 21.4e-6, 0.05e-6);
  EXPECT_NEAR(zurich.z(), -43e-6, 0.05e-6);                                           // down, on the northern half
  EXPECT_NEAR(std::atan2(zurich.x(), zurich.y()), 3.0 * M_PI / 180.0, 1e-12);         // east of north
  EXPECT_LT((FluxDensity({30e-6, 0.0, 0.0}) - Vec3(0, 30e-6, 0)).norm(), kRounding);  // at the equator: north
}

TEST(Magnetometer, ReadsTheFieldInItsOwnAxes) {
  MagnetometerConfig c = Ideal();
  c.orientation = {0.5, -0.3, 0.2};
  Magnetometer magnetometer(c, 1, "m");
  const Quat q_WB = base::FromYawPitchRoll(2.0, 0.4, -0.7), q_BM = base::FromYawPitchRoll(0.5, -0.3, 0.2);
  const Vec3 B_W = FluxDensity({});
  EXPECT_LT((magnetometer.Sample(q_WB, B_W, 30.0).magnetic_field - (q_WB * q_BM).conjugate() * B_W).norm(), kRounding);
}

// Facing magnetic north, forward has the horizontal part; facing magnetic west, the right-hand side has it.
TEST(Magnetometer, NorthIsWhereTheNeedlePoints) {
  Magnetometer magnetometer(Ideal(), 1, "m");
  const MagneticFieldConfig field;
  const Vec3 B_W = FluxDensity(field);
  const double north = M_PI / 2 - field.declination;  // yaw, 0 along east
  const double H = field.intensity * std::cos(field.inclination), Z = field.intensity * std::sin(field.inclination);
  const Vec3 to_north = magnetometer.Sample(base::FromYaw(north), B_W, 0.0).magnetic_field;
  const Vec3 to_west = magnetometer.Sample(base::FromYaw(north + M_PI / 2), B_W, 0.0).magnetic_field;
  EXPECT_LT((to_north - Vec3(H, 0, -Z)).norm(), kRounding);
  EXPECT_LT((to_west - Vec3(0, -H, -Z)).norm(), kRounding);
}

TEST(Magnetometer, SoftIronActsOnTheFieldAndOnThatOfTheCurrent) {
  MagnetometerConfig c = Ideal();
  c.soft_iron.scale = {0.1, -0.2, 0.0};
  c.soft_iron.nonorthogonality = {0.0, 0.0, 0.05};
  c.per_ampere = {1e-6, 0.0, -2e-6};
  Magnetometer magnetometer(c, 1, "m");
  const Vec3 B(10e-6, 20e-6, -30e-6), with_current = B + 3.0 * c.per_ampere;
  const auto expected = [](const Vec3& b) { return Vec3(1.1 * b.x(), 0.8 * b.y(), b.z() + 0.05 * b.y()); };
  EXPECT_LT((magnetometer.Sample(Quat::Identity(), B, 0.0).magnetic_field - expected(B)).norm(), kRounding);
  EXPECT_LT((magnetometer.Sample(Quat::Identity(), B, 3.0).magnetic_field - expected(with_current)).norm(), kRounding);
}

// 4000 samples of three axes: sigma to 0.65 %; the offset stays what the seed drew.
TEST(Magnetometer, NoiseIsWhiteAndHardIronConstant) {
  MagnetometerConfig c = Ideal();
  c.noise = 50e-9;
  c.hard_iron_sigma = 5e-6;
  Magnetometer magnetometer(c, 1, "m"), again(c, 1, "m"), other(c, 2, "m");
  c.noise = 0.0;
  const Vec3 hard_iron = Magnetometer(c, 1, "m").Sample(Quat::Identity(), Vec3::Zero(), 0.0).magnetic_field;
  EXPECT_GT(hard_iron.norm(), 0.5e-6);
  double squares = 0.0, product = 0.0;
  Vec3 last = Vec3::Zero();
  constexpr int kSamples = 4000;
  for (int i = 0; i < kSamples; ++i) {
    const Vec3 m = magnetometer.Sample(Quat::Identity(), Vec3::Zero(), 0.0).magnetic_field;
    ASSERT_EQ(m, again.Sample(Quat::Identity(), Vec3::Zero(), 0.0).magnetic_field);
    const Vec3 n = m - hard_iron;
    squares += n.squaredNorm();
    product += n.dot(last);
    last = n;
  }
  EXPECT_NEAR(std::sqrt(squares / (3.0 * kSamples)), 50e-9, 4 * 0.0065 * 50e-9);
  EXPECT_NEAR(product / squares, 0.0, 4 / std::sqrt(3.0 * kSamples));
  EXPECT_GT((other.Sample(Quat::Identity(), Vec3::Zero(), 0.0).magnetic_field - hard_iron).norm(), 0.5e-6);
}

TEST(Magnetometer, RoundsToWholeQuantaWithinItsRange) {
  MagnetometerConfig c = Ideal();
  c.quantum = 0.3e-6;
  c.range = 100e-6;  // 333.3 quanta
  Magnetometer magnetometer(c, 1, "m");
  const Vec3 m = magnetometer.Sample(Quat::Identity(), {10.1e-6, -500e-6, 500e-6}, 0.0).magnetic_field;
  EXPECT_NEAR(m.x(), 10.2e-6, kRounding);
  EXPECT_NEAR(m.y(), -333 * 0.3e-6, kRounding);
  EXPECT_NEAR(m.z(), 333 * 0.3e-6, kRounding);
}

}  // namespace
}  // namespace alula::sim
