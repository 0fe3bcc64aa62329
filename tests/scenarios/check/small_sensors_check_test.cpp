#include "scenarios/check/small_sensors_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scenarios/check/gimbal_check.h"
#include "tests/scenarios/check/test_bench.h"

namespace alula::scenarios::check {
namespace {

using testing::Failed, testing::Names;

TEST(SmallSensorsCheck, Barometer) {
  Rig rig = testing::EmptyRig();
  const sim::BarometerConfig claimed;
  rig.sensors.barometer = claimed;
  Report right;
  CheckBarometer(rig, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  rig.sensors.barometer = sim::BarometerConfig{{60, 1}, 1.1 * claimed.noise, 1.3 * claimed.weather_sigma};
  Report wrong;
  CheckBarometer(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"rate", "noise, 1 sigma", "day's offset and noise, 1 sigma"})) << ToTable(wrong);
}

TEST(SmallSensorsCheck, PositionReference) {
  Rig rig = testing::EmptyRig();
  const sim::PositionReferenceConfig claimed;
  rig.sensors.position_reference = claimed;
  Report right;
  CheckPositionReference(rig, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  rig.sensors.position_reference = sim::PositionReferenceConfig{
      claimed.rate, 1.1 * claimed.position_noise, 0.9 * claimed.attitude_noise, base::Milliseconds(21), std::nullopt};
  Report wrong;
  CheckPositionReference(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"position noise, 1 sigma", "attitude noise, 1 sigma", "delay"})) << ToTable(wrong);
}

TEST(SmallSensorsCheck, GnssReceiver) {
  Rig rig = testing::EmptyRig();
  sim::GnssReceiverConfig claimed;
  claimed.horizontal = claimed.vertical = 0.0;
  rig.sensors.gnss = claimed;
  rig.sensors.position_reference = sim::PositionReferenceConfig{};
  Report right;
  CheckGnssReceiver(rig, claimed, right);
  CheckPositionReference(rig, *rig.sensors.position_reference, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  rig.sensors.gnss->rate = {10, 1};
  rig.sensors.gnss->noise *= 1.1;
  rig.sensors.gnss->delay = base::Milliseconds(119);
  Report wrong;
  CheckGnssReceiver(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"rate", "noise, 1 sigma", "delay"})) << ToTable(wrong);
}

TEST(SmallSensorsCheck, Battery) {
  Rig rig = testing::EmptyRig();
  const sim::SensorsConfig claimed = rig.sensors;
  Report right;
  CheckBattery(rig, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  rig.sensors.battery_noise *= 1.1;
  Report wrong;
  CheckBattery(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), Names{"noise, 1 sigma"}) << ToTable(wrong);
}

TEST(GimbalCheck, LagSpeedStopsAndNoise) {
  sim::GimbalConfig claimed;
  claimed.name = "nick";
  claimed.stabilised = true;
  Rig rig = testing::EmptyRig();
  rig.sensors.gimbals = {claimed};
  Report right;
  CheckGimbal(rig, 0, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  sim::GimbalConfig& built = rig.sensors.gimbals[0];
  built.lag = base::Milliseconds(66);
  built.fastest *= 0.9;
  built.low[1] += 0.01;
  built.encoder_noise *= 1.2;
  built.levelling_error *= 1.3;
  Report wrong;
  CheckGimbal(rig, 0, claimed, wrong);
  EXPECT_EQ(Failed(wrong), (Names{"lag", "pitch, highest speed", "yaw, highest speed", "pitch, lower stop",
                                  "encoder noise, 1 sigma", "levelling error, 1 sigma"}))
      << ToTable(wrong);
}

TEST(Rows, WhatWasNotMeasuredFails) {
  EXPECT_TRUE(Compare("s", "q", 1.0, 1.1, 0.11, "m").passed);
  EXPECT_FALSE(Compare("s", "q", 1.0, 1.2, 0.11, "m").passed);
  EXPECT_FALSE(Compare("s", "q", 1.0, std::nan(""), 1e9, "m").passed);
}

}  // namespace
}  // namespace alula::scenarios::check
