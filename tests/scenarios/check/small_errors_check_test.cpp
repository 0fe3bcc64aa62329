// Each quantity is found where it is right, and found out where it is not.
#include "scenarios/check/small_errors_check.h"

#include <gtest/gtest.h>

#include "scenarios/check/rotor_check.h"
#include "tests/scenarios/check/test_bench.h"

namespace alula::scenarios::check {
namespace {

using testing::Failed, testing::Names;

TEST(SmallErrorsCheck, Barometer) {
  Rig rig = testing::EmptyRig();
  sim::BarometerConfig claimed;
  claimed.drift = 15.0;
  claimed.drift_time = 5.0;
  claimed.wind_pressure = {0.1, -0.2, 0.3};
  claimed.ground_pressure = 1.0;
  rig.sensors.barometer = claimed;
  Report right;
  CheckBarometerErrors(rig, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  rig.sensors.barometer->drift *= 1.3;
  rig.sensors.barometer->drift_time *= 1.6;
  rig.sensors.barometer->wind_pressure.y() = 0.0;
  rig.sensors.barometer->ground_pressure = 1.1;
  Report wrong;
  CheckBarometerErrors(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"drift, 1 sigma", "drift's correlation time", "wind pressure, y", "ground pressure"}))
      << ToTable(wrong);
}

TEST(SmallErrorsCheck, Gnss) {
  Rig rig = testing::EmptyRig();
  sim::PositionReferenceConfig claimed;
  claimed.rate = {5, 1};
  claimed.gnss = sim::GnssConfig{.horizontal = 1.0,
                                 .vertical = 2.0,
                                 .correlation_time = 20.0,
                                 .outage_rate = 0.05,
                                 .outage_length = 4.0,
                                 .outages = {{base::Seconds(100.0), base::Seconds(120.0)}}};
  rig.sensors.position_reference = claimed;
  Report right;
  CheckGnss(rig, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::GnssConfig& built = *rig.sensors.position_reference->gnss;
  built.vertical *= 1.3;
  built.outage_rate *= 2.0;
  built.outages.clear();
  Report wrong;
  CheckGnss(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"wandering z, 1 sigma", "fixes in planned outages", "share of fixes lost by chance"}))
      << ToTable(wrong);
}

// Beside another source of fixes, which must not be taken for it.
TEST(SmallErrorsCheck, GnssReceiver) {
  Rig rig = testing::EmptyRig();
  sim::GnssReceiverConfig claimed;
  claimed.correlation_time = 20.0;
  claimed.outage_rate = 0.05;
  rig.sensors.gnss = claimed;
  rig.sensors.position_reference = sim::PositionReferenceConfig{};
  Report right;
  CheckGnss(rig, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  rig.sensors.gnss->horizontal *= 1.3;
  rig.sensors.gnss->outage_length *= 2.0;
  Report wrong;
  CheckGnss(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"wandering x, 1 sigma", "wandering y, 1 sigma", "share of fixes lost by chance"}))
      << ToTable(wrong);
}

TEST(SmallErrorsCheck, BatteryGauge) {
  Rig rig = testing::EmptyRig();
  rig.sensors.battery_gauge = {.voltage_scale = 0.01,
                               .voltage_offset = -0.05,
                               .voltage_quantum = 0.005,
                               .current_scale = 0.03,
                               .current_offset = 0.4,
                               .current_noise = 0.3,
                               .current_quantum = 0.1};
  const sim::SensorsConfig claimed = rig.sensors;
  Report right;
  CheckBatteryGauge(rig, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  rig.sensors.battery_gauge.voltage_scale = 0.015;
  rig.sensors.battery_gauge.current_offset = 0.5;
  rig.sensors.battery_gauge.current_quantum = 0.11;
  Report wrong;
  CheckBatteryGauge(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"voltage scale", "current offset", "current, distance from whole quanta"}))
      << ToTable(wrong);
}

TEST(RotorCheck, GroundEffectAndVortexRing) {
  vehicles::QuadrotorConfig claimed;
  claimed.rotor.ground_effect.emplace();
  claimed.rotor.vortex_ring.emplace();
  Report right;
  CheckRotors(claimed, claimed, 1, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  vehicles::QuadrotorConfig built = claimed;
  built.rotor.ground_effect->body_lift = 1.0;
  built.rotor.vortex_ring->thrust_loss = 0.4;
  built.rotor.vortex_ring->fluctuation = 0.2;
  Report wrong;
  CheckRotors(built, claimed, 1, wrong);
  const Names failed = Failed(wrong);
  EXPECT_TRUE(failed.contains("ground effect, thrust at 1.5 R")) << ToTable(wrong);
  EXPECT_TRUE(failed.contains("vortex ring, thrust at 1 v_h")) << ToTable(wrong);
  EXPECT_TRUE(failed.contains("vortex ring, fluctuation at 1 v_h")) << ToTable(wrong);
  EXPECT_FALSE(failed.contains("vortex ring, thrust at 0.2 v_h")) << ToTable(wrong);
}

}  // namespace
}  // namespace alula::scenarios::check
