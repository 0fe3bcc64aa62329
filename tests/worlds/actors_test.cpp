#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "base/error.h"
#include "worlds/actors/actor_simulation.h"
#include "worlds/actors/drive.h"
#include "worlds/actors/gait.h"
#include "worlds/actors/grass.h"
#include "worlds/actors/machines.h"
#include "worlds/actors/outline.h"
#include "worlds/actors/path.h"
#include "worlds/actors/person.h"
#include "worlds/actors/social_force.h"
#include "worlds/actors/sway.h"
#include "worlds/courtyard.h"

namespace alula::worlds {
namespace {

using base::Milliseconds;
using base::Time;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kPi = std::numbers::pi;

/// A vehicle that is far away and does nothing.
ActorStimulus Nobody() { return {.p_WB = {500.0, 500.0, 2.0}}; }

std::size_t LinkNamed(const Actor& actor, const std::string& name) {
  for (std::size_t i = 0; i < actor.links.size(); ++i) {
    if (actor.links[i].name == name) return i;
  }
  ADD_FAILURE() << "no link " << name;
  return 0;
}

/// Balls of both feet, from the poses that everyone gets.
std::array<Vec3, 2> BallsOf(const World& world, const ActorSimulation& actors, Time t, double height) {
  const Actor& actor = world.actors[0];
  std::vector<Transform> X_WL(actor.links.size());
  actors.PlaceLinks(0, t, X_WL);
  const Proportions size(height);
  std::array<Vec3, 2> balls;
  for (std::size_t side = 0; side < 2; ++side) {
    const std::size_t foot = LinkNamed(actor, side == 0 ? "left_foot" : "right_foot");
    balls[side] = X_WL[foot] * actor.links[foot].X_JL.Inverse() * Vec3(size.ball, 0.0, -size.ankle);
  }
  return balls;
}

World Walker(const Walk& walk) {
  World world;
  AddPerson(world, "person", walk, 1);
  return world;
}

TEST(Gait, AFootThatStandsDoesNotMove) {
  for (const double speed : {0.5, 1.3, 1.9}) {
    SCOPED_TRACE(speed);
    const Walk walk{.route = {{0, 0, 0}, {40, 0, 0}}, .speed = speed, .height = 1.75};
    const World world = Walker(walk);
    ActorSimulation actors(world, 3);
    std::array<Vec3, 2> before = BallsOf(world, actors, {0}, walk.height);
    int touch_downs = 0;
    double worst = 0.0;
    for (int ms = 1; ms <= 12'000; ++ms) {
      const Time t = Time{} + Milliseconds(ms);
      actors.Advance(t, Nobody());
      const std::array<Vec3, 2> now = BallsOf(world, actors, t, walk.height);
      constexpr double kStands = 1e-6;  // m above the ground, for rounding of poses
      EXPECT_LT(std::min(now[0].z(), now[1].z()), 1e-6) << "at " << ms << " ms nobody stands";
      for (std::size_t side = 0; side < 2; ++side) {
        const bool stood = before[side].z() < kStands;
        const bool stands = now[side].z() < kStands;
        if (stood && stands) worst = std::max(worst, (now[side] - before[side]).norm());
        if (!stood && stands) ++touch_downs;
        EXPECT_GT(now[side].z(), -1e-6);
      }
      before = now;
    }
    EXPECT_LT(worst, 1e-6) << "m that a standing ball slides in a millisecond";
    // Two touch-downs a stride; jitter and the start cost a step or so.
    const double strides = 12.0 * speed / StrideLength(walk.height, speed);
    EXPECT_NEAR(touch_downs, 2.0 * strides, 2.5);
  }
}

TEST(Gait, LegsKeepTheirLengthAndFeetStayOnThem) {
  const Walk walk{.route = {{0, 0, 0}, {6, 0, 0}, {6, 5, 0}, {0, 5, 0}}, .closed = true, .speed = 1.4, .height = 1.8};
  const World world = Walker(walk);
  ActorSimulation actors(world, 5);
  const Proportions size(walk.height);
  const Actor& actor = world.actors[0];
  const std::size_t shin = LinkNamed(actor, "right_shin");
  const std::size_t foot = LinkNamed(actor, "right_foot");
  double worst = 0.0;
  double lowest = 10.0, highest = 0.0;
  std::vector<Transform> X_WL(actor.links.size());
  for (int ms = 0; ms <= 15'000; ms += 3) {
    const Time t = Time{} + Milliseconds(ms);
    actors.Advance(t, Nobody());
    actors.PlaceLinks(0, t, X_WL);
    const Vec3 ankle_of_shin = X_WL[shin] * actor.links[shin].X_JL.Inverse() * Vec3(0, 0, -size.shin);
    const Vec3 ankle_of_foot = (X_WL[foot] * actor.links[foot].X_JL.Inverse()).p;
    worst = std::max(worst, (ankle_of_shin - ankle_of_foot).norm());
    const double pelvis = actors.RootPose(0, t).p.z();
    lowest = std::min(lowest, pelvis);
    highest = std::max(highest, pelvis);
  }
  EXPECT_LT(worst, 0.02) << "m between shin and foot";  // interpolation between ticks, and sharp turns
  EXPECT_GT(lowest, 0.42 * walk.height);                // a walk, not a crouch
  EXPECT_LT(highest, 0.54 * walk.height);
  EXPECT_LT(highest - lowest, 0.12) << "m of bobbing";
}

TEST(RoundedPath, TurnsNoTighterThanItsRadiusAndItsHeadingIsItsTangent) {
  const RoundedPath path({{0, 0, 0}, {20, 0, 1}, {20, 15, 1}, {0, 15, 0}}, true, 4.0, "test");
  EXPECT_NEAR(path.length(), 70.0 - 4 * 2 * 4.0 + 2 * kPi * 4.0, 1e-9);
  constexpr double kStep = 1e-4;
  for (double s = 0.0; s < path.length(); s += 0.137) {
    const RoundedPath::Point a = path.At(s);
    const RoundedPath::Point b = path.At(s + kStep);
    const Vec2 tangent = (b.p - a.p).head<2>() / kStep;
    EXPECT_NEAR(tangent.norm(), 1.0, 1e-6);
    EXPECT_NEAR(base::WrapAngle(std::atan2(tangent.y(), tangent.x()) - a.heading), 0.0, 1e-4);
    EXPECT_LE(std::abs(a.curvature), 0.25 + 1e-12);
    EXPECT_LT((b.p - a.p).norm(), 1.1 * kStep) << "a jump at " << s;
  }
  EXPECT_THROW(RoundedPath({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}}, false, 4.0, "test"), base::InputError);
  EXPECT_THROW(RoundedPath({{0, 0, 0}, {30, 0, 0}, {0, 0.01, 0}}, false, 4.0, "test"), base::InputError);
}

/// V(b) of the paper, by itself.
double Potential(const Repulsion& repulsion, const Vec2& r, const Vec2& v) {
  const double r1 = r.norm(), r2 = (r - 2.0 * v).norm(), stride = 2.0 * v.norm();
  return repulsion.strength * std::exp(-0.5 * std::sqrt((r1 + r2) * (r1 + r2) - stride * stride) / repulsion.range);
}

TEST(SocialForce, IsMinusTheGradientOfItsPotential) {
  base::RandomStream random(1, "test");
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 200; ++i) {
    const Vec2 r(random.Uniform(-2, 2), random.Uniform(-2, 2));
    const Vec2 v(random.Uniform(-1, 1), random.Uniform(-1, 1));
    const Repulsion repulsion{2.1, 0.6};
    const double V = Potential(repulsion, r, v);
    if (V < 1e-6 || V > 2.1 * std::exp(-0.1 / 0.6)) continue;  // far, or within 0.1 m of where it walks: held finite
    const Vec2 force = BodyForce(repulsion, r, v, Vec2(-r.normalized()));  // looking at it
    for (int axis = 0; axis < 2; ++axis) {
      Vec2 step = Vec2::Zero();
      step[axis] = kStep;
      const double slope = (Potential(repulsion, r + step, v) - Potential(repulsion, r - step, v)) / (2.0 * kStep);
      EXPECT_NEAR(force[axis], -slope, 1e-5 * (1.0 + std::abs(slope)));
    }
  }
  const Vec2 seen = BodyForce({}, {1.0, 0.0}, Vec2::Zero(), {-1.0, 0.0});
  const Vec2 behind = BodyForce({}, {1.0, 0.0}, Vec2::Zero(), {1.0, 0.0});
  EXPECT_NEAR(behind.norm(), 0.5 * seen.norm(), 1e-12);
}

TEST(Walk, APersonStopsForTheVehicleOrDoesNotHeedIt) {
  for (const bool reactive : {true, false}) {
    const World world = Walker({.route = {{0, 0, 0}, {12, 0, 0}}, .speed = 1.2, .reactive = reactive});
    ActorSimulation actors(world, 2);
    const ActorStimulus vehicle{.p_WB = {6.0, 0.0, 1.2}, .radius = 0.25};
    double nearest = 1e9;
    for (int i = 1; i <= 700; ++i) {
      actors.Advance(Time{} + Milliseconds(10 * i), vehicle);
      nearest =
          std::min(nearest, (actors.RootPose(0, Time{} + Milliseconds(10 * i)).p - vehicle.p_WB).head<2>().norm());
    }
    if (reactive) {
      EXPECT_GT(nearest, 0.6);
    } else {
      EXPECT_LT(nearest, 0.2) << "walks through where it hovers";
    }
  }
}

TEST(Crowd, KeepsClearOfWhatStandsAndIsTheSameForTheSameSeed) {
  CourtyardConfig config;
  config.people = 6;
  const World world = MakeWorld(config, 4);
  ASSERT_EQ(world.actors.size(), 6U);
  ActorSimulation a(world, 4);
  ActorSimulation b(world, 4);
  const std::vector<Outline> outlines = OutlinesOf(world);
  double walked = 0.0;
  std::vector<Vec3> before(6, Vec3::Zero());
  for (int i = 1; i <= 3000; ++i) {
    const Time t = Time{} + Milliseconds(10 * i);
    a.Advance(t, Nobody());
    if (i % 3 == 0) a.LinkPoses(t);  // who asks changes nothing
    b.Advance(t, Nobody());
    for (std::size_t k = 0; k < 6; ++k) {
      const Vec3 p = a.RootPose(k, t).p;
      EXPECT_EQ(p, b.RootPose(k, t).p);
      for (const Outline& outline : outlines) {
        if (outline.high < 0.1 || outline.low > 1.5) continue;
        EXPECT_GT(GapTo(outline, p.head<2>()).distance, 0.2);
      }
      if (i > 1) walked += (p - before[k]).head<2>().norm();
      before[k] = p;
    }
  }
  EXPECT_GT(walked / 6.0, 15.0) << "m that each walked in 30 s";
}

TEST(Crowd, ThatDoesNotFitIsOneClearLine) {
  World world = MakeWorld(CourtyardConfig{}, 1);
  try {
    AddCrowd(world, "person", {.count = 40, .low = {0, 0}, .high = {2, 2}}, 1);
    FAIL() << "forty people in four square metres";
  } catch (const base::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("person: no free room for 40 people"), std::string::npos) << error.what();
  }
}

TEST(Car, DrivesItsPathWithBoundedCurvatureAndRollingWheels) {
  World world;
  const Drive drive{.waypoints = {{0, 0, 0}, {40, 0, 0}, {40, 30, 0}, {0, 30, 0}}, .closed = true, .speed = 8.0};
  AddCar(world, "car", drive, 1);
  ActorSimulation actors(world, 1);
  const std::size_t wheel = LinkNamed(world.actors[0], "wheel2/tyre");  // rear left: it does not steer
  std::vector<Transform> X_WL(world.actors[0].links.size());
  Transform before;
  double angle = 0.0, distance = 0.0;
  base::Quat wheel_before;
  for (int i = 0; i <= 2000; ++i) {
    const Time t = Time{} + Milliseconds(10 * i);
    actors.Advance(t, Nobody());
    const Transform X_WC = actors.RootPose(0, t);
    actors.PlaceLinks(0, t, X_WL);
    const base::Quat q_CL = X_WC.q.conjugate() * X_WL[wheel].q;
    if (i > 0) {
      const double moved = (X_WC.p - before.p).norm();
      const double turned = base::Log(before.q.conjugate() * X_WC.q).norm();
      EXPECT_LE(turned, moved / drive.turn_radius + 1e-6);
      EXPECT_LE(moved / 0.01, drive.speed + 1e-6);
      EXPECT_LE(moved * turned / 1e-4, 2.4) << "m/s² sideways: 2, looked for every half metre";
      distance += moved;
      angle += base::Log(wheel_before.conjugate() * q_CL).norm();
    }
    before = X_WC;
    wheel_before = q_CL;
  }
  EXPECT_NEAR(angle * drive.wheel_radius, distance, 1e-3 * distance);  // chords of 0.02 rad or less
  EXPECT_GT(distance, 80.0);
}

TEST(Car, WaitsForWhatIsInItsWay) {
  World world;
  AddCar(world, "car", {.waypoints = {{0, 0, 0}, {60, 0, 0}}, .speed = 10.0}, 1);
  AddPerson(world, "person", {.route = {{40, 0.3, 0}}, .speed = 0.0}, 1);
  ActorSimulation actors(world, 1);
  Time t;
  for (int i = 1; i <= 1500; ++i) actors.Advance(t = Time{} + Milliseconds(10 * i), Nobody());
  const double front = actors.RootPose(0, t).p.x() + FrontReach(std::get<Drive>(world.actors[0].motion));
  EXPECT_LT(front, 39.3);
  EXPECT_GT(front, 36.5) << "it does not stop far off";
}

TEST(Swing, AGateFollowsItsFrame) {
  CourtyardConfig config;
  config.swinging_gates = 2;
  const World world = MakeWorld(config, 3);
  ActorSimulation actors(world, 3);
  int swinging = 0;
  for (int i = 0; i <= 800; ++i) {
    const Time t = Time{} + Milliseconds(10 * i);
    actors.Advance(t, Nobody());
    swinging = 0;
    for (const Gate& gate : world.gates) {
      const Transform X_WG = actors.GatePose(gate, t);
      if (gate.actor < 0) {
        EXPECT_EQ(X_WG.p, gate.X_WG.p);
        continue;
      }
      ++swinging;
      const Swing& swing = std::get<Swing>(world.actors[static_cast<std::size_t>(gate.actor)].motion);
      const double angle = swing.amplitude * std::sin(2.0 * kPi * (t.Seconds() / swing.period + swing.phase));
      EXPECT_NEAR(base::WrapAngle(base::Yaw(X_WG.q) - base::Yaw(gate.X_WG.q)), angle, 1e-9);
      const Vec3 arm = gate.X_WG.p - swing.X_WH.p;
      const Vec3 expected = swing.X_WH.p + base::FromYaw(angle) * arm;
      EXPECT_LT((X_WG.p - expected).norm(), 1e-9);
    }
  }
  EXPECT_EQ(swinging, 2);
}

TEST(Grass, LeansWithTheWindAndAwayFromTheDownwash) {
  // The resting lean satisfies its equation, and half a radian at the speed that is stated.
  for (const double speed : {0.5, 3.0, 6.0, 12.0}) {
    const double lean = RestingLean(speed, 6.0);
    const double c = 0.5 / std::pow(std::cos(0.5), 2) * speed * speed / 36.0;
    EXPECT_NEAR(lean, c * std::pow(std::cos(lean), 2), 1e-6);
  }
  EXPECT_NEAR(RestingLean(6.0, 6.0), 0.5, 1e-9);
  // Poreh et al.: at r = h, u h / √K = 1.32.
  EXPECT_NEAR(GroundJetSpeed(1.225 * 4.0, 1.5, 1.5, 100.0) * 1.5 / 2.0, 1.32, 1e-12);

  World world;
  AddGrass(world, "grass", {.tufts = 60}, 1);
  const Sway& sway = std::get<Sway>(world.actors[0].motion);
  ActorSimulation actors(world, 1);
  const ActorStimulus hover{.p_WB = {0, 0, 1.0}, .thrust = 7.4};
  Time t;
  for (int i = 1; i <= 200; ++i) actors.Advance(t = Time{} + Milliseconds(10 * i), hover);
  std::vector<Transform> X_WL(60);
  actors.PlaceLinks(0, t, X_WL);
  double mean = 0.0;
  for (std::size_t i = 0; i < 60; ++i) {
    const Vec3 up = X_WL[i].q * Vec3::UnitZ();
    const Vec2 out = sway.X_WR[i].p.head<2>().normalized();
    EXPECT_GT(up.head<2>().dot(out), -0.02) << "tuft " << i;  // far ones sway about upright
    mean += up.head<2>().dot(out) / 60.0;
  }
  EXPECT_GT(mean, 0.05);
}

TEST(ActorSimulation, RemembersAQuarterOfASecond) {
  const World world = Walker({.route = {{0, 0, 0}, {20, 0, 0}}});
  ActorSimulation actors(world, 1);
  std::map<int, Vec3> seen;
  for (int ms = 1; ms <= 1000; ++ms) {
    actors.Advance(Time{} + Milliseconds(ms), Nobody());
    seen[ms] = actors.RootPose(0, Time{} + Milliseconds(ms)).p;
    if (ms <= 260) continue;
    EXPECT_EQ(actors.RootPose(0, Time{} + Milliseconds(ms - 250)).p, seen[ms - 250]);
  }
}

}  // namespace
}  // namespace alula::worlds
