// Ground effect and vortex ring against their sources' limits, and in the quadrotor that feels them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "vehicles/ground_effect.h"
#include "vehicles/quadrotor.h"
#include "vehicles/vortex_ring.h"

namespace alula::vehicles {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(GroundEffect, OneRotorIsCheesemanAndBennett) {
  // Other rotors and the body far away: T/T∞ = 1 / (1 − (R/4z)²), 1.067 at z = R.
  const RotorSpacing alone{.radius = 0.1, .adjacent = 1e6, .opposite = 1e6};
  for (const double z : {0.1, 0.15, 0.3, 1.0}) {
    EXPECT_NEAR(GroundEffectRatio({}, alone, z, 0.0), 1.0 / (1.0 - std::pow(0.1 / (4.0 * z), 2)), 1e-9);
  }
}

TEST(GroundEffect, GrowsTowardsTheGroundAndVanishesAloft) {
  const RotorSpacing spacing{.radius = 0.065, .adjacent = 0.177, .opposite = 0.25};
  double before = 2.0;
  for (double z = 0.04; z < 1.2; z *= 1.1) {
    const double ratio = GroundEffectRatio({}, spacing, z, 0.0);
    EXPECT_LT(ratio, before);
    EXPECT_GT(ratio, 1.0);
    before = ratio;
  }
  EXPECT_LT(GroundEffectRatio({}, spacing, kGroundReach * 0.065, 0.0), 1.005);
  EXPECT_EQ(GroundEffectRatio({}, spacing, kInfinite, 0.0), 1.0);
  // The discs at which this vehicle stands, by hand: 1 / (1 − 0.1126).
  EXPECT_NEAR(GroundEffectRatio({}, spacing, 0.092, 0.0), 1.127, 0.003);
  // Horizontal air at the induced velocity halves the bracket.
  const double calm = GroundEffectRatio({}, spacing, 0.1, 0.0), windy = GroundEffectRatio({}, spacing, 0.1, 1.0);
  EXPECT_NEAR(1.0 - 1.0 / windy, 0.5 * (1.0 - 1.0 / calm), 1e-12);
}

TEST(VortexRing, FormsBetweenItsLimitsOnly) {
  const VortexRingConfig c;
  EXPECT_EQ(VortexRingStrength(c, -1.0, 0.0), 0.0);  // climb
  EXPECT_EQ(VortexRingStrength(c, c.begin, 0.0), 0.0);
  EXPECT_EQ(VortexRingStrength(c, c.end, 0.0), 0.0);
  EXPECT_EQ(VortexRingStrength(c, c.worst, 0.0), 1.0);
  EXPECT_NEAR(VortexRingStrength(c, 0.5 * (c.begin + c.worst), 0.0), 0.5, 1e-12);
  EXPECT_EQ(VortexRingStrength(c, c.worst, c.swept), 0.0);
}

/// Force along z of the q250 at half command, falling at `descent` m/s, `height` above ground; per (N of static
/// thrust).
double Ratio(const QuadrotorConfig& config, double descent, double height, std::uint64_t seed = 1) {
  const auto vehicle = MakeQuadrotor(config, "vehicle0", seed);
  BodyState state;
  state.v_WB.z() = -descent;
  vehicle->Above(std::vector<double>(kRotors, height));
  Wrench wrench;
  for (int i = 0; i < 400; ++i) {
    wrench = vehicle->Step(state, {std::vector<double>(kRotors, 0.5)}, base::Vec3::Zero(), base::Milliseconds(1));
  }
  double still = 0.0;
  for (const RotorState& rotor : vehicle->Rotors()) {
    still += ThrustConstant(config.rotor, config.air_density) * rotor.speed * rotor.speed;
    EXPECT_NEAR(rotor.radius, 0.5 * config.rotor.diameter, 1e-15);
  }
  return (wrench.force_W.z() - BodyDrag(config.aerodynamics, config.air_density, state.v_WB).z()) / still;
}

TEST(Quadrotor, FeelsTheGroundOnlyWhereToldTo) {
  QuadrotorConfig config;
  EXPECT_NEAR(Ratio(config, 0.0, 0.05), 1.0, 1e-12);
  EXPECT_EQ(MakeQuadrotor(config, "v")->GroundReach(), 0.0);
  config.rotor.ground_effect.emplace();
  EXPECT_GT(MakeQuadrotor(config, "v")->GroundReach(), 1.0);
  const double R = 0.5 * config.rotor.diameter, b = config.frame.wheelbase;
  EXPECT_NEAR(Ratio(config, 0.0, 0.1), GroundEffectRatio({}, {R, b / std::sqrt(2.0), b}, 0.1, 0.0), 1e-12);
  EXPECT_NEAR(Ratio(config, 0.0, kInfinite), 1.0, 1e-12);
}

TEST(Quadrotor, LosesThrustInItsOwnWake) {
  QuadrotorConfig config;
  const double descent = 7.7;                         // m/s: near the induced velocity of half command
  EXPECT_GT(Ratio(config, descent, kInfinite), 1.2);  // without the ring, descent gives thrust
  config.rotor.vortex_ring = VortexRingConfig{.fluctuation = 0.0};
  EXPECT_NEAR(Ratio(config, descent, kInfinite), 0.7, 0.05);
  EXPECT_NEAR(Ratio(config, -2.0, kInfinite), Ratio(QuadrotorConfig{}, -2.0, kInfinite), 1e-12);  // climb: nothing
  config.rotor.vortex_ring->fluctuation = 0.1;
  EXPECT_NE(Ratio(config, descent, kInfinite, 1), Ratio(config, descent, kInfinite, 2));
  EXPECT_EQ(Ratio(config, descent, kInfinite, 1), Ratio(config, descent, kInfinite, 1));
}

}  // namespace
}  // namespace alula::vehicles
