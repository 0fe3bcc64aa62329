// Barometer, satellites and the battery's gauge against their closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "sim/sensors/barometer.h"
#include "sim/sensors/battery_gauge.h"
#include "sim/sensors/position_reference.h"

namespace alula::sim {
namespace {

BarometerConfig Quiet() {
  BarometerConfig c;
  c.noise = c.weather_sigma = 0.0;
  return c;
}

TEST(BarometerErrors, WindAddsItsShareOfTheDynamicPressure) {
  BarometerConfig c = Quiet();
  c.wind_pressure = {0.5, 0.0, -0.2};
  Barometer barometer(c, 1, "b");
  const double p = barometer.Sample(0.0, {.v_air_B = {-4.0, 9.0, 2.0}}).pressure;
  EXPECT_NEAR(p - StandardPressure(0.0), 0.5 * 1.225 * (0.5 * 16.0 - 0.2 * 4.0), 1e-9);
}

TEST(BarometerErrors, CushionNearTheGround) {
  BarometerConfig c = Quiet();
  EXPECT_EQ(GroundReach(c), 0.0);
  c.ground_pressure = 1.5;
  EXPECT_GT(GroundReach(c), 0.0);
  Barometer barometer(c, 1, "b");
  // 100 Pa of disc loading, one rotor height of two radii: 1.5 · 100 / 8².
  const std::vector<vehicles::RotorState> rotors{{.thrust = 100.0 * std::numbers::pi * 0.01, .radius = 0.1},
                                                 {.thrust = 100.0 * std::numbers::pi * 0.01, .radius = 0.1}};
  const double near = barometer.Sample(0.0, {.rotors = rotors, .rotor_height = 0.2}).pressure;
  EXPECT_NEAR(near - StandardPressure(0.0), 150.0 / 64.0, 1e-9);
  EXPECT_EQ(barometer.Sample(0.0, {.rotors = rotors}).pressure, StandardPressure(0.0));
}

// 4000 correlation times: sigma to 1/√4000 = 1.6 %, the correlation after one time constant to 2 % of 1.
TEST(BarometerErrors, DriftIsGaussMarkov) {
  BarometerConfig c = Quiet();
  c.drift = 20.0;
  c.drift_time = 1.0;
  Barometer barometer(c, 1, "b");
  std::vector<double> d;
  for (int i = 0; i < 50 * 4000; ++i) d.push_back(barometer.Sample(0.0).pressure - StandardPressure(0.0));
  double square = 0.0, product = 0.0;
  for (std::size_t i = 0; i + 50 < d.size(); ++i) {
    square += d[i] * d[i];
    product += d[i] * d[i + 50];
  }
  EXPECT_NEAR(std::sqrt(square / static_cast<double>(d.size() - 50)), 20.0, 4 * 0.016 * 20.0);
  EXPECT_NEAR(product / square, std::exp(-1.0), 0.08);
}

TEST(Gnss, LosesFixesInItsWindowsAndMeasuresNoAttitude) {
  PositionReferenceConfig c;
  c.rate = {5, 1};
  c.position_noise = 0.0;
  c.gnss = GnssConfig{.outages = {{base::Seconds(10.0), base::Seconds(12.0)}}};
  PositionReference reference(c, 1, "r");
  const base::Transform X_WB{base::FromYaw(1.0), {1, 2, 3}};
  for (int i = 0; i < 100; ++i) {
    const base::Time t = c.rate.SampleTime(i);
    const auto fix = reference.Sample(t, X_WB);
    ASSERT_EQ(fix.has_value(), i < 50 || i >= 60) << i;
    if (!fix) continue;
    EXPECT_EQ(fix->attitude_sigma, kUnmeasuredAttitude);
    EXPECT_EQ(fix->X_WB.q.coeffs(), base::Quat::Identity().coeffs());
    EXPECT_NEAR(fix->position_sigma, std::sqrt((1.0 + 1.0 + 4.0) / 3.0), 1e-12);
    EXPECT_LT((fix->X_WB.p - X_WB.p).norm(), 10.0);
  }
}

TEST(Gnss, AnOutageShiftsNothingElse) {
  PositionReferenceConfig c;
  c.rate = {5, 1};
  c.gnss.emplace();
  PositionReference always(c, 1, "r");
  c.gnss->outage_rate = 0.1;
  PositionReference sometimes(c, 1, "r");
  int lost = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto a = always.Sample(c.rate.SampleTime(i), {}), b = sometimes.Sample(c.rate.SampleTime(i), {});
    if (!b) {
      ++lost;
    } else {
      ASSERT_EQ(a->X_WB.p, b->X_WB.p);
    }
  }
  // 400 s, 0.1 outages of 5 s a second of fixes: a third; ±√(2/27) of it is 1 σ.
  EXPECT_GT(lost, 200);
  EXPECT_LT(lost, 1300);
}

TEST(Gnss, AReceiverIsAPositionReferenceOfItsOwn) {
  GnssReceiverConfig receiver;
  receiver.horizontal = 3.0;
  const PositionReferenceConfig reference = ReferenceOf(receiver);
  EXPECT_EQ(reference.rate.Hz(), 5.0);
  EXPECT_EQ(reference.position_noise, receiver.noise);
  EXPECT_EQ(reference.delay, receiver.delay);
  ASSERT_TRUE(reference.gnss.has_value());
  EXPECT_EQ(reference.gnss->horizontal, 3.0);
}

TEST(BatteryGauge, ScaleOffsetAndQuantum) {
  const BatteryGaugeConfig c{.voltage_scale = 0.01,
                             .voltage_offset = -0.1,
                             .voltage_quantum = 0.05,
                             .current_scale = -0.1,
                             .current_offset = 0.5,
                             .current_quantum = 0.2};
  const stack::BatterySample read = Gauge(c, {14.8, 20.0}, 0.01, 0.05);
  EXPECT_NEAR(read.voltage, 14.85, 1e-12);  // 14.858
  EXPECT_NEAR(read.current, 18.6, 1e-12);   // 18.55
  const stack::BatterySample ideal = Gauge({}, {14.8, 20.0}, 0.0, 0.0);
  EXPECT_EQ(ideal.voltage, 14.8);
  EXPECT_EQ(ideal.current, 20.0);
}

}  // namespace
}  // namespace alula::sim
