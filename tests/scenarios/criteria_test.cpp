#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "scenarios/criteria/ate.h"
#include "scenarios/criteria/bounds.h"
#include "scenarios/criteria/contacts.h"
#include "scenarios/criteria/gates.h"
#include "scenarios/criteria/hover_error.h"
#include "scenarios/criteria/hull.h"
#include "scenarios/criteria/landed.h"
#include "scenarios/criteria/mean_speed.h"
#include "scenarios/criteria/target_reached.h"
#include "scenarios/criteria/time_limit.h"
#include "tests/sim/test_world.h"
#include "worlds/actors/machines.h"

namespace alula::scenarios {
namespace {

using base::Transform;
using base::Vec3;

class StillVehicle : public vehicles::VehicleModel {
 public:
  StillVehicle() : body_(sim::testing::PlateOnLegs()) { body_.prescribed = true; }
  const vehicles::VehicleBody& body() const override { return body_; }
  vehicles::Wrench Step(const vehicles::BodyState&, const vehicles::ActuatorCommand&, const Vec3&,
                        base::Duration) override {
    return {};
  }
  stack::BatterySample Battery() const override { return {}; }
  std::vector<vehicles::TelemetryValue> Telemetry() const override { return {}; }

 private:
  vehicles::VehicleBody body_;
};

/// Shows a criterion one step after another without a loop.
class Film {
 public:
  explicit Film(worlds::World world)
      : world_(std::move(world)), physics_(world_, vehicle_.body(), sim::testing::At({0, 0, 0.1})) {}

  /// The next step ends at `X` at time `t` (s).
  std::optional<std::string> Show(sim::Observer& observer, double t, const Transform& X) {
    const base::Time end = base::Time{} + base::Seconds(t);
    const double dt = (end - window_.end).Seconds();
    actors_.Advance(end, {.p_WB = X.p});
    const Vec3 v = dt > 0 ? Vec3((X.p - window_.at_end.X_WB.p) / dt) : Vec3::Zero();
    window_ = {window_.end, end, window_.at_end, {X, v, Vec3::Zero()}};
    physics_.MovePrescribed(window_.at_end);
    return observer.Observe(View());
  }
  std::optional<std::string> Show(sim::Observer& observer, double t, const Vec3& p) {
    return Show(observer, t, Transform{base::Quat::Identity(), p});
  }
  stack::VehicleStatus status;
  std::vector<sim::Contact> contacts;
  const stack::StackOutput* output = nullptr;

 private:
  sim::StepView View() {
    return {.time = window_.end,
            .truth = window_,
            .contacts = contacts,
            .measurements = {},
            .output = output,
            .status = status,
            .actuators = actuators_,
            .wind_W = wind_,
            .physics = physics_,
            .vehicle = vehicle_,
            .autopilot = nullptr,
            .world = world_,
            .actors = actors_,
            .imu_bias = {}};
  }
  worlds::World world_;
  worlds::ActorSimulation actors_{world_, 1};
  StillVehicle vehicle_;
  sim::PhysicsWorld physics_;
  sim::TruthWindow window_{{0}, {0}, sim::testing::At({0, 0, 0.1}), sim::testing::At({0, 0, 0.1})};
  vehicles::ActuatorCommand actuators_;
  Vec3 wind_ = Vec3::Zero();
};

worlds::World TwoGates() {
  worlds::World world = sim::testing::GroundAndCrate();
  world.objects.resize(1);  // the ground
  world.gates.push_back({"gate0", {base::Quat::Identity(), {2, 0, 1.5}}, 1.2, 0.15});
  world.gates.push_back({"gate1", {base::FromYaw(M_PI / 2), {4, 2, 1.5}}, 1.2, 0.15});
  world.target = {4, 4, 1.5};
  return world;
}

double Measured(const Criterion& criterion, const std::string& name) {
  for (const Check& check : criterion.Checks()) {
    if (check.name == name) return check.measured;
  }
  ADD_FAILURE() << "no check is called " << name;
  return NAN;
}
bool Passed(const Criterion& criterion) {
  for (const Check& check : criterion.Checks()) {
    if (!check.passed) return false;
  }
  return true;
}

TEST(Gates, CountsPassagesInOrderAndForward) {
  Film film(TwoGates());
  Gates gates({});
  film.Show(gates, 1, Vec3(1, 0.1, 1.4));
  film.Show(gates, 2, Vec3(3, 0.1, 1.4));
  EXPECT_EQ(Measured(gates, "gates_passed"), 1);
  film.Show(gates, 3, Vec3(4, 1, 1.5));
  film.Show(gates, 4, Vec3(4, 3, 1.5));
  EXPECT_EQ(Measured(gates, "gates_passed"), 2);
  // Opening 0.6 either way, offset 0.1, plate 0.1 wide and 0.02 high: sideways 0.4 is left, upwards 0.48.
  EXPECT_NEAR(Measured(gates, "gate_margin"), 0.4, 1e-12);
  EXPECT_TRUE(Passed(gates));
}

/// A gate on a hinge, passed through its middle as it hangs there: swung out by its amplitude, and at rest.
TEST(Gates, JudgesASwingingGateWhereItIs) {
  for (const double t : {0.5, 2.0}) {
    worlds::World world = sim::testing::GroundAndCrate();
    world.objects.resize(1);
    worlds::AddSwingingGate(world, 0, "gate0", {{2.0, 0.0}, 0.0, 1.5, 1.0, 0.1}, {.amplitude = 0.5, .period = 2.0});
    const worlds::Swing swing = std::get<worlds::Swing>(world.actors[0].motion);
    const base::Quat turn = base::FromYaw(0.5 * std::sin(M_PI * t));
    const Vec3 middle = swing.X_WH.p + turn * (world.gates[0].X_WG.p - swing.X_WH.p);
    Film film(std::move(world));
    Gates gates({});
    film.Show(gates, t - 0.001, Transform{turn, middle - turn * Vec3(0.1, 0, 0)});
    film.Show(gates, t, Transform{turn, middle + turn * Vec3(0.1, 0, 0)});
    EXPECT_EQ(Measured(gates, "gates_passed"), 1);
    // Half the opening less half the plate; the frame moves by 0.8 mm in the millisecond.
    EXPECT_NEAR(Measured(gates, "gate_margin"), 0.4, 2e-3);
  }
}

TEST(Gates, BackwardsSkippedAndOutsideDoNotCount) {
  Film film(TwoGates());
  Gates backwards({});
  film.Show(backwards, 1, Vec3(3, 0, 1.5));
  film.Show(backwards, 2, Vec3(1, 0, 1.5));
  // (0 → 3 passes beside the opening: it crosses the plane at z = 1.03, inside; so begin anew from above.)
  Film high(TwoGates());
  Gates outside({});
  high.Show(outside, 1, Vec3(0, 0, 4));
  high.Show(outside, 2, Vec3(3, 0, 4));
  EXPECT_EQ(Measured(outside, "gates_passed"), 0);
  EXPECT_EQ(Measured(outside, "wrong_gate_passages"), 0);
  high.Show(outside, 3, Vec3(3, 0, 1.5));
  high.Show(outside, 4, Vec3(1, 0, 1.5));  // gate 0 from behind
  EXPECT_EQ(Measured(outside, "wrong_gate_passages"), 1);
  high.Show(outside, 5, Vec3(1, 0, 4));
  high.Show(outside, 6, Vec3(4, 1, 4));
  high.Show(outside, 7, Vec3(4, 1, 1.5));
  high.Show(outside, 8, Vec3(4, 3, 1.5));  // gate 1 before gate 0
  EXPECT_EQ(Measured(outside, "wrong_gate_passages"), 2);
  EXPECT_EQ(Measured(outside, "gates_passed"), 0);
  EXPECT_FALSE(Passed(outside));
}

TEST(Gates, HullThatReachesIntoTheFrameFails) {
  Film film(TwoGates());
  Gates gates({});
  film.Show(gates, 1, Vec3(1, 0.55, 1.5));
  film.Show(gates, 2, Vec3(3, 0.55, 1.5));
  EXPECT_NEAR(Measured(gates, "gate_margin"), -0.05, 1e-12);
  EXPECT_FALSE(Passed(gates));
}

TEST(Hull, ReachIsTheFarthestPointOfAnyPart) {
  base::RandomStream random(2, "test/hull");
  const vehicles::VehicleBody body = sim::testing::PlateOnLegs();  // the plate alone is hull
  for (int i = 0; i < 100; ++i) {
    const Vec3 d = random.GaussianVec3().normalized();
    EXPECT_NEAR(HullReach(body, d), Vec3(0.1, 0.1, 0.02).dot(d.cwiseAbs()), 1e-12);
  }
}

TEST(Contacts, LegsOnThePadMayAndNothingElse) {
  Film film(TwoGates());  // its pad is the ground
  Contacts contacts({});
  film.contacts = {{"leg0", "ground", true, Vec3::Zero(), 0.0}};
  EXPECT_FALSE(film.Show(contacts, 1, Vec3(0, 0, 0.1)));
  EXPECT_TRUE(Passed(contacts));
  film.contacts = {{"leg0", "gate0/left", true, Vec3::Zero(), 0.0}};
  EXPECT_EQ(film.Show(contacts, 2, Vec3(0, 0, 0.1)), "contact");
  film.contacts = {{"plate", "ground", false, Vec3::Zero(), 0.0}};
  film.Show(contacts, 3, Vec3(0, 0, 0.1));
  EXPECT_EQ(Measured(contacts, "forbidden_contacts"), 1);  // one touch that lasted
  EXPECT_FALSE(Passed(contacts));
}

TEST(TargetReached, NeedsGatesNearnessAndRest) {
  Film film(TwoGates());
  TargetReached target({});
  film.Show(target, 1, Vec3(4, 4, 1.5));
  EXPECT_FALSE(film.Show(target, 3, Vec3(4, 4, 1.5)));  // at rest there, but no gate was passed
  film.Show(target, 4, Vec3(1, 0, 1.5));
  film.Show(target, 5, Vec3(3, 0, 1.5));
  film.Show(target, 6, Vec3(4, 1, 1.5));
  film.Show(target, 7, Vec3(4, 4, 1.5));
  film.Show(target, 7.1, Vec3(4, 4, 1.5));
  EXPECT_FALSE(Passed(target));
  EXPECT_EQ(film.Show(target, 7.7, Vec3(4, 4, 1.5)), "target_reached");
  EXPECT_TRUE(Passed(target));
}

TEST(MeanSpeed, IsPathOverTimeFromTheColumnToTheTarget) {
  Film film(TwoGates());
  MeanSpeed speed({.least = 1.0});
  film.Show(speed, 5, Vec3(0, 0, 1.5));    // climbing does not count
  film.Show(speed, 6, Vec3(1.5, 0, 1.5));  // leaves the column of 1 m within this step
  film.Show(speed, 7, Vec3(3, 0, 1.5));
  film.Show(speed, 8, Vec3(4, 1, 1.5));
  film.Show(speed, 9, Vec3(4, 4, 1.5));
  film.Show(speed, 99, Vec3(4, 4, 1.5));  // after the target does not count
  const double path = 1.5 + 1.5 + std::sqrt(2.0) + 3.0;
  EXPECT_NEAR(Measured(speed, "mean_speed"), path / 3.0, 1e-9);
}

TEST(TimeLimit, EndsTheRunAndFails) {
  Film film(TwoGates());
  TimeLimit limit({base::Seconds(2.0)});
  EXPECT_FALSE(film.Show(limit, 1, Vec3(0, 0, 1)));
  EXPECT_TRUE(Passed(limit));
  EXPECT_EQ(film.Show(limit, 2, Vec3(0, 0, 1)), "time_limit");
  EXPECT_FALSE(Passed(limit));
}

TEST(Bounds, MeasuresHowFarOutside) {
  worlds::World world = TwoGates();
  world.bounds_low = {-5, -5, 0};
  world.bounds_high = {5, 5, 3};
  Film film(world);
  Bounds bounds({});
  EXPECT_FALSE(film.Show(bounds, 1, Vec3(4, 0, 1)));
  EXPECT_EQ(film.Show(bounds, 2, Vec3(5.5, 0, 3.2)), "out_of_bounds");
  EXPECT_NEAR(Measured(bounds, "out_of_bounds"), 0.5, 1e-12);
}

TEST(Landed, NeedsAFlightRestAndRotorsOff) {
  Film film(TwoGates());
  Landed landed({});
  film.contacts = {{"leg0", "ground", true, Vec3::Zero(), 0.0}};
  film.Show(landed, 1, Vec3(0, 0, 0.1));
  EXPECT_FALSE(film.Show(landed, 2, Vec3(0, 0, 0.1)));  // never flew
  film.status.armed = true;
  film.Show(landed, 3, Vec3(0, 0, 2));
  film.Show(landed, 4, Vec3(0, 0, 0.1));
  EXPECT_FALSE(film.Show(landed, 6, Vec3(0, 0, 0.1)));  // armed
  film.status.armed = false;
  film.Show(landed, 7, Vec3(0, 0, 0.1));
  EXPECT_EQ(film.Show(landed, 8, Vec3(0, 0, 0.1)), "landed");
  EXPECT_TRUE(Passed(landed));
}

TEST(HoverError, MeasuresItsWindowAndFailsWithoutOne) {
  Film film(TwoGates());
  HoverError hover({.point = {0, 0, 1.5}});
  EXPECT_FALSE(Passed(hover));
  for (double t = 0.5; t < 12; t += 0.01) film.Show(hover, t, Vec3(0.03, 0.04, 1.6));
  EXPECT_NEAR(Measured(hover, "hover_rms_error"), 0.05, 1e-9);  // stands at 0.1 + 1.5
  EXPECT_NEAR(Measured(hover, "hover_largest_error"), 0.05, 1e-9);
}

/// RMSE after the best of many yaws, each with its best shift.
double BruteForceRmse(const std::vector<Vec3>& e, const std::vector<Vec3>& t) {
  double best = 1e9;
  for (int i = 0; i < 36000; ++i) {
    const base::Quat q = base::FromYaw(i * 2e-4 * M_PI / 3.6);
    Vec3 mean = Vec3::Zero();
    for (std::size_t k = 0; k < e.size(); ++k) mean += (t[k] - q * e[k]) / static_cast<double>(e.size());
    double sum = 0;
    for (std::size_t k = 0; k < e.size(); ++k) sum += (t[k] - q * e[k] - mean).squaredNorm();
    best = std::min(best, std::sqrt(sum / static_cast<double>(e.size())));
  }
  return best;
}

TEST(FourDofAlignment, AgreesWithBruteForce) {
  base::RandomStream random(4, "test/ate");
  std::vector<Vec3> estimate, truth;
  trajectory::FourDofAlignment alignment;
  double squares = 0;
  for (int i = 0; i < 30; ++i) {
    truth.push_back({random.Uniform(-9, 9), random.Uniform(-6, 6), random.Uniform(0, 3)});
    estimate.push_back(base::FromYaw(-0.4) * Vec3(truth.back() - Vec3(1, 2, 3)) + 0.2 * random.GaussianVec3());
    alignment.Add(estimate.back(), truth.back());
    squares += (estimate.back() - truth.back()).squaredNorm();
  }
  EXPECT_NEAR(alignment.AlignedRmse(), BruteForceRmse(estimate, truth), 1e-5);
  EXPECT_NEAR(alignment.UnalignedRmse(), std::sqrt(squares / 30), 1e-12);
  EXPECT_NEAR(alignment.yaw(), 0.4, 0.02);
}

TEST(Ate, ComparesAtTheStampOfTheEstimate) {
  Film film(TwoGates());
  Ate ate({});
  EXPECT_FALSE(Passed(ate));  // no estimate at all
  for (int i = 1; i < 2000; ++i) {
    const double stamp = (i - 40) * 1e-3;  // 40 ms old
    stack::StackOutput output;
    output.estimate.emplace();
    output.estimate->stamp = base::Time{} + base::Seconds(stamp);
    output.estimate->X_OB.p = {2.0 * stamp, 0.0, 1.0};
    output.estimate->X_MO.p = {0.0, 0.3, 0.0};
    film.output = stamp > 0 ? &output : nullptr;
    film.Show(ate, i * 1e-3, Vec3(2.0 * i * 1e-3, 0, 1));
  }
  EXPECT_LT(Measured(ate, "ate_online"), 1e-6);
  EXPECT_NEAR(Measured(ate, "ate_unaligned"), 0.3, 1e-3);
}

}  // namespace
}  // namespace alula::scenarios
