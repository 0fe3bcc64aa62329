// Each quantity is found where it is right, and found out where it is not.
#include "scenarios/check/magnetometer_check.h"

#include <gtest/gtest.h>

#include "tests/scenarios/check/test_bench.h"

namespace alula::scenarios::check {
namespace {

using testing::Failed, testing::Names;

sim::MagnetometerConfig Worn() {
  sim::MagnetometerConfig c;
  c.orientation = {1.5, 0.2, -0.1};
  c.noise = 40e-9;
  c.hard_iron_sigma = 8e-6;
  c.soft_iron.scale = {0.05, -0.03, 0.02};
  c.soft_iron.misalignment = {0.01, -0.02, 0.03};
  c.soft_iron.nonorthogonality = {0.01, 0.02, -0.015};
  c.per_ampere = {0.2e-6, -0.1e-6, 0.3e-6};
  return c;
}

TEST(MagnetometerCheck, FindsWhatIsConfigured) {
  Rig rig = testing::EmptyRig();
  for (const sim::MagnetometerConfig& config : {sim::MagnetometerConfig{}, Worn()}) {
    rig.sensors.magnetometer = config;
    Report report;
    CheckMagnetometer(rig, config, report);
    EXPECT_EQ(Failed(report), Names{}) << ToTable(report);
  }
}

TEST(MagnetometerCheck, FindsOutEachError) {
  const sim::MagnetometerConfig claimed = Worn();
  const auto failed = [&claimed](const auto& change) {
    Rig rig = testing::EmptyRig();
    rig.sensors.magnetometer = claimed;
    change(*rig.sensors.magnetometer);
    Report report;
    CheckMagnetometer(rig, claimed, report);
    return Failed(report);
  };
  using Config = sim::MagnetometerConfig;
  EXPECT_EQ(failed([](Config& c) { c.rate = {60, 1}; }), Names{"rate"});
  EXPECT_EQ(failed([](Config& c) { c.noise *= 1.05; }), Names{"noise, 1 sigma"});
  EXPECT_EQ(failed([](Config& c) { c.hard_iron_sigma *= 1.2; }), Names{"hard iron, 1 sigma"});
  EXPECT_EQ(failed([](Config& c) { c.soft_iron.scale.y() += 1e-3; }), Names{"soft iron scale y"});
  EXPECT_EQ(failed([](Config& c) { c.soft_iron.nonorthogonality.z() += 1e-3; }),
            Names{"soft iron nonorthogonality, y in z"});
  EXPECT_TRUE(failed([](Config& c) { c.orientation.x() += 1e-3; }).contains("soft iron misalignment z"));
  EXPECT_EQ(failed([](Config& c) { c.per_ampere.z() *= 1.1; }), Names{"field per ampere z"});
  EXPECT_EQ(failed([](Config& c) { c.quantum *= 2.0; }), Names{"quantum"});
  EXPECT_EQ(failed([](Config& c) { c.quantum = 0.0; }), Names{"quantum"});
  EXPECT_EQ(failed([](Config& c) { c.range *= 0.9; }), Names{"saturation"});
}

TEST(MagnetometerCheck, AContinuousSensorIsNotQuantised) {
  sim::MagnetometerConfig claimed;
  claimed.quantum = 0.0;
  Rig rig = testing::EmptyRig();
  rig.sensors.magnetometer = claimed;
  Report right, wrong;
  CheckMagnetometer(rig, claimed, right);
  EXPECT_EQ(Failed(right), Names{}) << ToTable(right);
  rig.sensors.magnetometer->quantum = 13e-9;
  CheckMagnetometer(rig, claimed, wrong);
  EXPECT_EQ(Failed(wrong), Names{"quantum"}) << ToTable(wrong);
}

}  // namespace
}  // namespace alula::scenarios::check
