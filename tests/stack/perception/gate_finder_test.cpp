#include "stack/perception/gate_finder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "tests/stack/mapping/synthetic_scene.h"

namespace alula::stack::perception {
namespace {

using mapping::test::Corrupt;
using mapping::test::HalfSizeShape;
using mapping::test::Scene;

/// A gate as courses have them, in a corner with ground, a wall behind, a crate, a tree and the gate's own feet.
struct Course {
  Scene scene;
  base::Transform X_OG;
  GateHint hint;
};

Course DrawCourse(base::RandomStream& random, bool feet) {
  Course course;
  const double opening = random.Uniform(1.2, 1.6);
  const double bar = random.Uniform(0.12, 0.2);
  const double height = random.Uniform(0.5 * opening + 0.45, 2.2);
  course.X_OG = {base::FromYaw(random.Uniform(-0.5, 0.5)), {0, 0, height}};
  Scene& scene = course.scene;
  scene.AddGate(course.X_OG, opening, bar, bar);
  if (feet) {
    const double foot = height - 0.5 * opening - bar;
    for (const double side : {-1.0, 1.0}) {
      const base::Transform X_GF{base::Quat::Identity(), {0, side * 0.5 * (opening + bar), 0.5 * foot - height}};
      scene.boxes.push_back({course.X_OG * X_GF, {0.05, 0.05, 0.5 * foot}});
    }
  }
  scene.AddBox({0, 0, -0.5}, {20, 20, 0.5});
  scene.AddBox({random.Uniform(2.0, 6.0), 0, 1.5}, {0.1, 12, random.Uniform(1.0, 1.5)});
  scene.AddBox({random.Uniform(1.2, 2.5), random.Uniform(-2, 2), 0.4}, {0.4, 0.4, 0.4});
  scene.AddBox({random.Uniform(0.3, 1.0), random.Uniform(1.5, 2.5) * (random.Uniform() < 0.5 ? -1 : 1), 1.5},
               {0.15, 0.15, 1.5});

  const double error = random.Uniform(0.3, 0.6);
  const double direction = random.Uniform(0, 2 * M_PI);
  const base::Vec3 off(random.Uniform(-0.25, 0.25), error * std::cos(direction), error * std::sin(direction));
  // Survey error in the plane, and misalignment of the map frame on top.
  const base::Transform X_GH{base::FromYaw(random.Uniform(-0.2, 0.2)),
                             off + 0.15 * random.GaussianVec3().cwiseMax(-1.5).cwiseMin(1.5)};
  course.hint = {"gate", course.X_OG * X_GH, opening};
  return course;
}

struct Error {
  double in_plane = 0.0;
  double normal = 0.0;
  double yaw = 0.0;
};

Error ErrorOf(const GateObservation& seen, const base::Transform& X_OG) {
  const base::Vec3 p_G = X_OG.Inverse() * seen.X_OG.p;
  return {p_G.tail<2>().norm(), std::abs(p_G.x()),
          std::abs(base::WrapAngle(base::Yaw(seen.X_OG.q) - base::Yaw(X_OG.q)))};
}

double Median(std::vector<double> values) {
  if (values.empty()) return 1e9;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Approaches along a line that leads `sideways` m beside the gate's normal, looking at the hint.
base::Transform OnApproach(const base::Transform& X_OG, const base::Vec3& look_at_O, double distance, double sideways,
                           double up) {
  const base::Vec3 p_OC = X_OG * base::Vec3(-distance, sideways * distance / 5.0, up);
  const base::Vec3 to = look_at_O - p_OC;
  return {base::FromYaw(std::atan2(to.y(), to.x())) * base::ForwardCameraRotation(), p_OC};
}

TEST(GateFinder, ApproachesConvergeToTheTrueGate) {
  std::map<int, std::vector<Error>> errors;  // by distance, decimetres
  std::map<int, int> seen_at;
  std::vector<double> in_plane_ratio;
  std::vector<double> yaw_ratio;
  const int runs = 12;
  for (int run = 0; run < runs; ++run) {
    base::RandomStream random(1000 + run, "test/gates");
    const Course course = DrawCourse(random, run % 2 == 0);
    GateFinder finder({course.hint}, {});
    const double sideways = random.Uniform(-2.0, 2.0);
    const double up = std::max(random.Uniform(-0.4, 0.4), 0.6 - course.X_OG.p.z());
    for (int step = 24; step >= 6; step -= 2) {
      const double distance = 0.2 * step;
      const base::Vec3 look_at = finder.Best(0) ? finder.Best(0)->X_OG.p : course.hint.X_WG.p;
      const base::Transform X_OC = OnApproach(course.X_OG, look_at, distance, sideways, up);
      finder.Add(Corrupt(course.scene.Depth(HalfSizeShape(), X_OC), 0.15, 0.07, 0.1, random), X_OC, {});
      const auto best = finder.Best(0);
      if (!best) continue;
      const Error e = ErrorOf(*best, course.X_OG);
      errors[2 * step].push_back(e);
      if (step == 10) {
        in_plane_ratio.push_back(e.in_plane / best->position_sigma);
        yaw_ratio.push_back(e.yaw / best->yaw_sigma);
      }
    }
  }
  for (const auto& [decimetres, list] : errors) {
    std::vector<double> in_plane, normal, yaw;
    for (const Error& e : list) {
      in_plane.push_back(e.in_plane);
      normal.push_back(e.normal);
      yaw.push_back(e.yaw * 180 / M_PI);
    }
    std::printf("%.1f m: seen %2zu of %d, in plane median %.3f worst %.3f m, normal %.3f %.3f m, yaw %.1f %.1f deg\n",
                0.1 * decimetres, list.size(), runs, Median(in_plane),
                *std::max_element(in_plane.begin(), in_plane.end()), Median(normal),
                *std::max_element(normal.begin(), normal.end()), Median(yaw),
                *std::max_element(yaw.begin(), yaw.end()));
  }
  const auto bound = [&](int decimetres, double in_plane_median, double in_plane_worst, double yaw_worst) {
    std::vector<double> in_plane;
    for (const Error& e : errors[decimetres]) {
      in_plane.push_back(e.in_plane);
      EXPECT_LT(e.in_plane, in_plane_worst) << decimetres;
      EXPECT_LT(e.yaw, yaw_worst * M_PI / 180) << decimetres;
    }
    EXPECT_LT(Median(in_plane), in_plane_median) << decimetres;
  };
  EXPECT_EQ(errors[20].size(), static_cast<std::size_t>(runs));
  EXPECT_GE(errors[40].size(), static_cast<std::size_t>(runs * 3 / 4));
  bound(40, 0.06, 0.12, 12);
  bound(20, 0.03, 0.05, 4);
  // The stated 1σ is neither boastful nor useless: a Rayleigh median is 1.18 σ, a half-normal one 0.67 σ.
  EXPECT_LT(Median(in_plane_ratio), 1.6);
  EXPECT_GT(Median(in_plane_ratio), 0.2);
  EXPECT_LT(Median(yaw_ratio), 1.2);
}

TEST(GateFinder, RefusesTwoBarsAndEmptyPlacesAndPlainWalls) {
  base::RandomStream random(5, "test/refusals");
  const GateHint hint{"gate", {base::Quat::Identity(), {0, 0.3, 1.5}}, 1.4};
  Scene two_bars;  // a corner: left upright and top
  two_bars.AddGate({base::Quat::Identity(), {0, 0, 1.5}}, 1.4, 0.15, 0.15);
  two_bars.boxes.erase(two_bars.boxes.begin(), two_bars.boxes.begin() + 2);
  Scene empty;
  Scene wall;
  wall.AddBox({0.1, 0, 1.5}, {0.1, 6, 3});
  Scene posts;  // two trees at the gate's width
  posts.AddBox({0, -0.8, 1.5}, {0.1, 0.1, 1.5});
  posts.AddBox({0, 0.8, 1.5}, {0.1, 0.1, 1.5});
  for (Scene* scene : {&two_bars, &empty, &wall, &posts}) {
    scene->AddBox({0, 0, -0.5}, {20, 20, 0.5});
    scene->AddBox({5, 0, 1.5}, {0.1, 12, 3});
    GateFinder finder({hint}, {});
    for (double distance = 4.5; distance > 1.4; distance -= 0.2) {
      const base::Transform X_OC = OnApproach(hint.X_WG, hint.X_WG.p, distance, 0.5, 0.0);
      finder.Add(Corrupt(scene->Depth(HalfSizeShape(), X_OC), 0.15, 0.07, 0.1, random), X_OC, {});
      EXPECT_FALSE(finder.Best(0).has_value()) << distance;
    }
  }
}

TEST(GateFinder, FollowsTheMapFrameAndKnowsWhichGateIsWhich) {
  base::RandomStream random(9, "test/two gates");
  const base::Transform X_OG{base::FromYaw(0.2), {3, 0, 1.6}};
  Scene scene;
  scene.AddGate(X_OG, 1.4, 0.15, 0.15);
  scene.AddBox({0, 0, -0.5}, {20, 20, 0.5});
  scene.AddBox({8, 0, 1.5}, {0.1, 12, 3});
  const base::Transform X_MO{base::FromYaw(1.0), {10, -4, 0.3}};
  const base::Transform elsewhere{base::FromYaw(0.0), {3, 5, 1.6}};
  const base::Transform off{base::Quat::Identity(), {0, 0.4, 0.2}};
  GateFinder finder({{"other", X_MO * elsewhere, 1.4}, {"this", X_MO * X_OG * off, 1.4}}, {});
  for (double x = -1.0; x < 1.4; x += 0.2) {
    const base::Transform X_OC{base::ForwardCameraRotation(), {x, 0, 1.5}};
    finder.Add(Corrupt(scene.Depth(HalfSizeShape(), X_OC), 0.15, 0.07, 0.1, random), X_OC, X_MO);
  }
  EXPECT_FALSE(finder.Best(0).has_value());
  ASSERT_TRUE(finder.Best(1).has_value());
  EXPECT_LT(ErrorOf(*finder.Best(1), X_OG).in_plane, 0.04);
  EXPECT_EQ(finder.Best(1)->bars, 4);
  EXPECT_THROW(GateFinder({{"flat", {}, 0.0}}, {}), base::InputError);
}

}  // namespace
}  // namespace alula::stack::perception
