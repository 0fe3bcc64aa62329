// Surfaces, ranges and optical flow against closed forms, for every maker.
#include "render/passes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "render/internal/projection.h"
#include "render/raster/raster_renderer.h"
#include "tests/render/each_maker.h"
#include "tests/render/test_scene.h"
#include "worlds/courtyard.h"

namespace alula::render {
namespace {

using Passes = test::EachMaker;
using internal::RayDirection;
using test::LookAt;
using worlds::SemanticClass;

std::size_t Index(int u, int v) { return static_cast<std::size_t>(v * 640 + u); }

/// A wall x = 6 over ground z = 0, a ball, and a plate that moves.
worlds::World Room() {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  test::AddBox(world, {base::Quat::Identity(), {0, 0, -0.5}}, {30, 30, 0.5}, 0);
  test::AddBox(world, {base::Quat::Identity(), {6.1, 0, 5}}, {0.1, 20, 5}, 0);
  world.objects.push_back({"ball", geometry::Sphere{0.5}, {base::Quat::Identity(), {4, 1.2, 1}}, 0});
  world.objects[0].semantic = SemanticClass::kGround;
  world.objects[1].semantic = SemanticClass::kWall;
  return world;
}
const std::vector<Mover>& Plate() {
  static const std::vector<Mover> movers = {
      {"marker", geometry::Box{base::Vec3::Constant(0.01)}, test::Plain(0.2F), SemanticClass::kGate},
      {"plate", geometry::Box{base::Vec3(0.02, 0.8, 0.6)}, test::Plain(0.9F)}};
  return movers;
}

TEST_P(Passes, SurfacesSayWhatIsSeenAndItsNormal) {
  const auto renderer = Make(Room(), Plate());
  const std::vector<base::Transform> poses = {{base::Quat::Identity(), {0, 0, -5}},
                                              {base::Exp(base::Vec3(0.1, -0.2, 0.3)), {3, -0.8, 1.2}}};
  renderer->PlaceMovers(poses);
  const View view = LookAt({0.2, 0.1, 1.1}, {5, 0.3, 1.0}, 0.15);
  SurfacePicture surface;
  renderer->Surface(view, surface);
  EXPECT_EQ(surface.first_mover, 4U);
  const base::Mat3 R_CW = view.X_WC.Inverse().R();
  const std::array<base::Vec3, 6> normals = {base::Vec3::Zero(), base::Vec3::UnitZ(), -base::Vec3::UnitX(),
                                             base::Vec3::Zero(), base::Vec3::Zero(),  -poses[1].R().col(0)};
  const std::array<SemanticClass, 6> classes = {SemanticClass::kSky,  SemanticClass::kGround,
                                                SemanticClass::kWall, SemanticClass::kObstacle,
                                                SemanticClass::kGate, SemanticClass::kVehicle};
  std::array<int, 6> seen{};
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const std::uint32_t instance = surface.instances[Index(u, v)];
      ASSERT_LT(instance, 6U);
      ++seen[instance];
      ASSERT_EQ(surface.classes[Index(u, v)], classes[instance]);
      const base::Vec3 n_C = surface.normals[Index(u, v)].cast<double>();
      if (instance == 3) {  // the ball: vertex normals are exact, the chord between them 15° at most
        const base::Vec3 d = RayDirection(view, u, v);
        const base::Vec3 o = view.X_WC.p - base::Vec3(4, 1.2, 1);
        const double b = o.dot(d);
        const double inside = b * b - d.squaredNorm() * (o.squaredNorm() - 0.25);
        if (inside < 0.1) continue;  // the rim, where facets and sphere part
        const base::Vec3 expected = R_CW * (o - d * ((b + std::sqrt(inside)) / d.squaredNorm())) / 0.5;
        ASSERT_LT((n_C - expected).norm(), 0.03);
        ASSERT_NEAR(n_C.norm(), 1.0, 1e-5);
      } else if (instance != 5 || n_C.dot(R_CW * normals[5]) > 0.5) {  // not the plate's narrow sides
        ASSERT_LT((n_C - R_CW * normals[instance]).norm(), 1e-5) << instance;
      }
    }
  }
  for (const std::size_t i : {1UL, 2UL, 3UL, 5UL}) EXPECT_GT(seen[i], 2000) << i;
  EXPECT_EQ(seen[4], 0);  // lies below the ground
}

TEST_P(Passes, SurfaceAndDepthSeeTheSamePixels) {
  const worlds::World world = test::Clutter(31);
  const auto renderer = Make(world);
  const View view = LookAt({-5, 1, 1.4}, {3, 0, 0.7}, 0.1);
  SurfacePicture surface;
  DepthPicture depth;
  renderer->Surface(view, surface);
  renderer->Depth(view, depth);
  for (std::size_t i = 0; i < depth.metres.size(); ++i) {
    ASSERT_EQ(surface.instances[i] == 0, depth.metres[i] == 0.0F);
    ASSERT_EQ(surface.instances[i] == 0, surface.classes[i] == SemanticClass::kSky);
  }
}

TEST(Surfaces, MakersAgreeAndTheScalarTwinIsEqual) {
  const worlds::World world = worlds::MakeWorld({.texture_size = 64}, 4);
  const auto gl = MakeRenderer("osmesa", world, {});
  const auto own = MakeRenderer("raster", world, {});
  raster::RasterRenderer twin(raster::ScalarKernels(), world, {});
  base::RandomStream random(6, "surfaces");
  std::size_t other = 0;
  std::size_t turned = 0;
  std::size_t pixels = 0;
  for (int pose = 0; pose < 5; ++pose) {
    View view = LookAt(test::RandomPose(random, {-10, -7, 0.5}, {10, 7, 2.5}).p,
                       test::RandomPose(random, {-12, -9, 0.0}, {12, 9, 3.0}).p, random.Uniform(-0.3, 0.3));
    if (pose == 4) view.intrinsics.width = 333;
    SurfacePicture a;
    SurfacePicture b;
    SurfacePicture c;
    gl->Surface(view, a);
    own->Surface(view, b);
    twin.Surface(view, c);
    EXPECT_TRUE(b.instances == c.instances && b.classes == c.classes && b.normals == c.normals);
    for (std::size_t i = 0; i < a.instances.size(); ++i) {
      ++pixels;
      other += a.instances[i] != b.instances[i] ? 1U : 0U;
      turned += a.instances[i] == b.instances[i] && (a.normals[i] - b.normals[i]).norm() > 1e-3F ? 1U : 0U;
    }
  }
  // Pixels on outlines, where corners are snapped to 1/256 px in both makers but not to the same side.
  EXPECT_LT(static_cast<double>(other), 1e-3 * static_cast<double>(pixels));
  EXPECT_LT(static_cast<double>(turned), 1e-3 * static_cast<double>(pixels));
}

TEST_P(Passes, RangeIsTheDistanceAlongTheRay) {
  const auto renderer = Make(Room());
  const View view = LookAt({0.2, 0.1, 1.1}, {5, 0.3, 0.9}, 0.15);
  DepthPicture depth;
  RangePicture range;
  renderer->Depth(view, depth);
  RangeFromDepth(view, depth, range);
  for (int v = 260; v < 480; v += 7) {
    for (int u = 0; u < 640; u += 7) {
      const base::Vec3 ray = RayDirection(view, u, v).normalized();
      const double ground = ray.z() < 0.0 ? -view.X_WC.p.z() / ray.z() : 1e9;
      const double wall = ray.x() > 0.0 ? (6.0 - view.X_WC.p.x()) / ray.x() : 1e9;
      const base::Vec3 o = view.X_WC.p - base::Vec3(4, 1.2, 1);
      if (o.dot(ray) * o.dot(ray) - o.squaredNorm() + 0.26 > 0.0) continue;  // the ball
      const double expected = std::min(ground, wall);
      ASSERT_NEAR(range.metres[Index(u, v)], expected, 1e-4 * expected + 1e-4) << u << " " << v;
    }
  }
  DepthPicture wrong = depth;
  wrong.width = 320;
  EXPECT_THROW(RangeFromDepth(view, wrong, range), base::FaultError);
}

/// Motion of pixel (u, v) that shows the plane through `point` with `normal` (in the mover's frame, or the world's).
base::Vec2 PlaneMotion(const Moment& first, const Moment& second, const base::Transform& X_WF1,
                       const base::Transform& X_WF2, const base::Vec3& point, const base::Vec3& normal, int u, int v) {
  const base::Transform X_F1W = X_WF1.Inverse();
  const base::Vec3 eye = X_F1W * first.view.X_WC.p;
  const base::Vec3 ray = X_F1W.R() * RayDirection(first.view, u, v);
  const base::Vec3 p_F = eye + ray * (normal.dot(point - eye) / normal.dot(ray));
  return test::Project(second.view, X_WF2 * p_F) - base::Vec2(u, v);
}

TEST_P(Passes, FlowOfPlanesAndOfAMovingPlateInClosedForm) {
  const auto renderer = Make(Room(), Plate());
  const std::vector<base::Transform> before = {{base::Quat::Identity(), {0, 0, -5}},
                                               {base::Exp(base::Vec3(0.1, -0.2, 0.3)), {3, -0.8, 1.2}}};
  const std::vector<base::Transform> after = {{base::Quat::Identity(), {0, 0, -5}},
                                              {base::Exp(base::Vec3(-0.1, 0.1, 0.2)), {3.2, -0.5, 1.3}}};
  const Moment first{LookAt({0.2, 0.1, 1.1}, {5, 0.3, 1.0}, 0.15), before};
  const Moment second{LookAt({0.4, -0.2, 1.3}, {5, -0.1, 1.0}, 0.1), after};
  DepthPicture depth;
  DepthPicture second_depth;
  SurfacePicture surface;
  renderer->PlaceMovers(before);
  renderer->Depth(first.view, depth);
  renderer->Surface(first.view, surface);
  renderer->PlaceMovers(after);
  renderer->Depth(second.view, second_depth);
  FlowPicture flow;
  OpticalFlow(first, depth, surface, second, &second_depth, flow);
  const std::array<base::Vec3, 6> points = {base::Vec3::Zero(), base::Vec3::Zero(), {6, 0, 0},
                                            base::Vec3::Zero(), base::Vec3::Zero(), {-0.02, 0, 0}};
  const std::array<base::Vec3, 6> normals = {base::Vec3::Zero(), base::Vec3::UnitZ(), base::Vec3::UnitX(),
                                             base::Vec3::Zero(), base::Vec3::Zero(),  base::Vec3::UnitX()};
  std::array<int, 5> fates{};
  double largest = 0.0;
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const std::size_t i = Index(u, v);
      const std::uint32_t instance = surface.instances[i];
      ++fates[static_cast<std::size_t>(flow.fates[i])];
      ASSERT_EQ(instance == 0, flow.fates[i] == FlowFate::kNothing);
      ASSERT_EQ(instance == 0, std::isnan(flow.motion[i].x()));
      if (instance == 0 || instance == 3) continue;
      const bool plate = instance == 5;
      if (plate && surface.normals[i].cast<double>().dot(first.view.X_WC.Inverse().R() * -before[1].R().col(0)) < 0.5)
        continue;  // its narrow sides
      const base::Vec2 expected =
          PlaneMotion(first, second, plate ? before[1] : base::Transform{}, plate ? after[1] : base::Transform{},
                      points[instance], normals[instance], u, v);
      ASSERT_LT((flow.motion[i].cast<double>() - expected).norm(), 2e-3 + 1e-4 * expected.norm()) << instance;
      largest = std::max(largest, expected.norm());
    }
  }
  EXPECT_GT(largest, 30.0);
  EXPECT_GT(fates[static_cast<std::size_t>(FlowFate::kSeen)], 200'000);
  EXPECT_GT(fates[static_cast<std::size_t>(FlowFate::kHidden)], 500);  // behind the plate and the ball
  EXPECT_GT(fates[static_cast<std::size_t>(FlowFate::kOutside)], 500);
  EXPECT_THROW(OpticalFlow(first, depth, surface, {second.view, {}}, nullptr, flow), base::FaultError);
}

// A wall that the camera slides along: u = −f t / z everywhere. And a camera that backs through its near plane.
TEST_P(Passes, FlowOfAWallAlongsideAndOfWhatComesToLieBehind) {
  worlds::World world;
  world.materials = {test::Plain(0.5F)};
  test::AddBox(world, {base::Quat::Identity(), {4.5, 0, 0}}, {0.5, 50, 50}, 0);
  const auto renderer = Make(world);
  const View view = LookAt({0, 0, 0}, {1, 0, 0});
  DepthPicture depth;
  SurfacePicture surface;
  FlowPicture flow;
  renderer->Depth(view, depth);
  renderer->Surface(view, surface);
  OpticalFlow({view, {}}, depth, surface, {LookAt({0, 0.2, 0}, {1, 0.2, 0}), {}}, nullptr, flow);
  for (const Eigen::Vector2f& motion : flow.motion) {
    ASSERT_NEAR(motion.x(), 381.4 * 0.2 / 4.0, 2e-3);  // the camera moves to its left
    ASSERT_NEAR(motion.y(), 0.0, 2e-3);
  }
  OpticalFlow({view, {}}, depth, surface, {LookAt({3.97, 0, 0}, {5, 0, 0}), {}}, nullptr, flow);
  for (std::size_t i = 0; i < flow.fates.size(); ++i) {
    ASSERT_EQ(flow.fates[i], FlowFate::kBehind);
    ASSERT_TRUE(std::isnan(flow.motion[i].x()));
  }
}

INSTANTIATE_TEST_SUITE_P(Makers, Passes, test::kEachMaker);

}  // namespace
}  // namespace alula::render
