#include "vehicles/quadrotor.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <variant>

#include "base/config.h"
#include "base/error.h"
#include "vehicles/multicopter_autopilot.h"
#include "vehicles/prescribed.h"

namespace alula::vehicles {
namespace {

struct AnyVehicle {
  std::variant<QuadrotorConfig, PrescribedConfig> vehicle;
};
void Describe(base::Description& d, AnyVehicle& c) {
  d.OneOf("vehicle", c.vehicle, {.meaning = "what flies", .choices = {"quadrotor", "prescribed"}});
}

AnyVehicle FromCatalog(const std::string& name) {
  const auto document = base::YamlDocument::Parse("vehicle:\n  extends: " + name + "\n", "test.yaml",
                                                  {std::filesystem::path("vehicles/catalog")});
  return base::ReadConfig<AnyVehicle>(document, 1);
}

TEST(Quadrotor, CatalogEntryIsTheDefault) {
  const AnyVehicle read = FromCatalog("q250");
  EXPECT_EQ(base::DumpConfig(std::get<QuadrotorConfig>(read.vehicle)), base::DumpConfig(QuadrotorConfig{}));
}

TEST(Quadrotor, PrescribedCatalogEntriesFly) {
  for (const std::string name : {"prescribed_gentle", "prescribed_lively"}) {
    const AnyVehicle read = FromCatalog(name);
    const auto vehicle = MakePrescribed(std::get<PrescribedConfig>(read.vehicle), "vehicle0");
    EXPECT_TRUE(vehicle->body().prescribed);
    EXPECT_GT(vehicle->PrescribedEnd()->Seconds(), 20) << name;
  }
}

TEST(Quadrotor, AutopilotConfigReadsBackWhatItDumps) {
  const std::string text = base::DumpConfig(MulticopterAutopilotConfig{});
  const auto document = base::YamlDocument::Parse(text, "dump.yaml");
  EXPECT_EQ(base::DumpConfig(base::ReadConfig<MulticopterAutopilotConfig>(document, 1)), text);
}

TEST(Quadrotor, BodyOriginIsTheCentreOfMassBetweenTheRotors) {
  const QuadrotorLayout layout = LayOutQuadrotor({});
  base::Vec3 middle = base::Vec3::Zero();
  for (const RotorMount& r : layout.rotors) middle += 0.25 * r.p_BR;
  EXPECT_NEAR(middle.x(), 0, 1e-12);
  EXPECT_NEAR(middle.y(), 0, 1e-12);
  EXPECT_NEAR((layout.rotors[0].p_BR - layout.rotors[1].p_BR).norm(), 0.25, 1e-12);
  double spin = 0;
  for (const RotorMount& r : layout.rotors) spin += r.spin;
  EXPECT_EQ(spin, 0);
}

TEST(Quadrotor, InertiaIsThatOfARealBodyAndScalesWithMass) {
  QuadrotorConfig c;
  const base::Mat3 I = LayOutQuadrotor(c).body.inertia;
  EXPECT_LT((I - I.transpose()).norm(), 1e-15);
  const base::Vec3 principal = Eigen::SelfAdjointEigenSolver<base::Mat3>(I).eigenvalues();
  EXPECT_GT(principal[0], 0);
  EXPECT_GT(principal[0] + principal[1], principal[2]);  // triangle inequality of every mass distribution
  c.mass *= 1.05;
  EXPECT_LT((LayOutQuadrotor(c).body.inertia - 1.05 * I).norm(), 1e-15);
}

TEST(Quadrotor, HullHoldsDiscsAndBodyButNotTheLegs) {
  const QuadrotorConfig c;
  const QuadrotorLayout layout = LayOutQuadrotor(c);
  const VehicleBody& body = layout.body;
  int discs = 0, legs = 0;
  for (const Part& part : body.parts) {
    if (part.name.starts_with("propeller")) discs += part.hull && part.collides;
    if (part.may_touch) {
      ++legs;
      EXPECT_FALSE(part.hull);
      EXPECT_TRUE(part.collides);
      EXPECT_NEAR(part.X_BP.p.z() - 0.5 * c.frame.leg_length, -body.standing_height, 1e-12);
    }
  }
  EXPECT_EQ(discs, 4);
  EXPECT_EQ(legs, 4);
  const double reach = 0.5 * (c.frame.wheelbase / std::sqrt(2.0) + c.rotor.diameter);
  EXPECT_NEAR(body.hull_half_extents.x(), reach, 1e-12);
  EXPECT_NEAR(body.hull_half_extents.y(), reach, 1e-12);
  EXPECT_GT(body.hull_radius, 0.5 * (c.frame.wheelbase + c.rotor.diameter));
  EXPECT_LT(body.hull_radius, body.hull_half_extents.norm());
  EXPECT_GT(body.standing_height, body.hull_half_extents.z());
}

TEST(Quadrotor, ThrustToWeightRatioLiesBetweenThreeAndFour) {
  const QuadrotorConfig c;
  const double full = 4 * ThrustConstant(c.rotor, c.air_density) * c.rotor.maximum_speed * c.rotor.maximum_speed;
  EXPECT_GT(full, 3 * c.mass * base::kGravity);
  EXPECT_LT(full, 4 * c.mass * base::kGravity);
}

TEST(Quadrotor, RefusesWhatCannotFly) {
  QuadrotorConfig heavy;
  heavy.mass = 3;
  EXPECT_THROW(MakeQuadrotor(heavy, "vehicle0"), base::InputError);
  QuadrotorConfig tight;
  tight.rotor.diameter = 0.2;
  EXPECT_THROW(MakeQuadrotor(tight, "vehicle0"), base::InputError);
  const auto vehicle = MakeQuadrotor({}, "vehicle0");
  EXPECT_THROW(vehicle->Step({}, {{0.1, 0.1}}, base::Vec3::Zero(), base::Milliseconds(1)), base::FaultError);
}

}  // namespace
}  // namespace alula::vehicles
