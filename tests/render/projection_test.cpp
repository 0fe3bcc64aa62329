#include "render/internal/projection.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/render/each_maker.h"
#include "tests/render/test_scene.h"

namespace alula::render {
namespace {

using PinholeProjection = test::EachMaker;
using test::LookAt;
using test::Project;

/// Signed distance of q to the edges of a convex polygon given clockwise in image coordinates (y down), px; positive
/// inside.
double InsideBy(const std::vector<base::Vec2>& corners, const base::Vec2& q) {
  double inside = 1e9;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const base::Vec2 edge = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
    const base::Vec2 to = q - corners[i];
    inside = std::min(inside, edge.x() * to.y() - edge.y() * to.x());
  }
  return inside;
}

base::Vec2 BrightCentroid(const Picture& picture) {
  base::Vec2 sum = base::Vec2::Zero();
  double count = 0;
  for (int v = 0; v < picture.height; ++v) {
    for (int u = 0; u < picture.width; ++u) {
      if (picture.bytes[static_cast<std::size_t>(v * picture.width + u)] < 128) continue;
      sum += base::Vec2(u, v);
      count += 1;
    }
  }
  return sum / count;
}

/// A bright plate with its face at x = 0, |y|, |z| ≤ 0.4, before a dark wall. Eyes with |y|, |z| < 0.4 see none of its
/// sides.
worlds::World Plate() {
  worlds::World world;
  world.light = test::Shadowless();
  world.materials = {test::Plain(1.0F), test::Plain(0.1F)};
  test::AddBox(world, {base::Quat::Identity(), {0.01, 0, 0}}, {0.01, 0.4, 0.4}, 0);
  test::AddBox(world, {base::Quat::Identity(), {3.0, 0, 0}}, {0.1, 30, 30}, 1);
  return world;
}

// Every pixel centre that lies more than 0.02 px from the analytic outline is on the side that it should be, in both
// eyes: the outline is drawn where it is to 0.02 px (llvmpipe snaps vertices to 1/256 px).
TEST_P(PinholeProjection, OutlineLiesWherePinholeEquationsPutItInBothEyes) {
  const auto renderer = Make(Plate());
  base::RandomStream random(7, "outline");
  for (int trial = 0; trial < 12; ++trial) {
    const base::Vec3 eye(-random.Uniform(1.0, 2.5), random.Uniform(-0.25, 0.25), random.Uniform(-0.35, 0.35));
    View view = LookAt(eye, {0, random.Uniform(-0.1, 0.1), random.Uniform(-0.1, 0.1)}, random.Uniform(-0.5, 0.5));
    view.intrinsics.cx += random.Uniform(-8, 8);
    const View left = view;
    view.X_WC = view.X_WC * base::Transform{base::Quat::Identity(), {0.11, 0, 0}};
    for (const View& camera : {left, view}) {
      Picture picture;
      renderer->Grey(camera, picture);
      std::vector<base::Vec2> corners;  // clockwise as seen from −x: top left first
      for (const auto& [y, z] : {std::pair{0.4, 0.4}, {-0.4, 0.4}, {-0.4, -0.4}, {0.4, -0.4}}) {
        corners.push_back(Project(camera, {0.0, y, z}));
      }
      int near_edge = 0;
      for (int v = 0; v < 480; ++v) {
        for (int u = 0; u < 640; ++u) {
          const double inside = InsideBy(corners, base::Vec2(u, v));
          const bool bright = picture.bytes[static_cast<std::size_t>(v * 640 + u)] >= 128;
          near_edge += std::abs(inside) < 0.1 ? 1 : 0;
          if (std::abs(inside) > 0.02) {
            EXPECT_EQ(bright, inside > 0.0) << u << " " << v << " inside by " << inside;
          }
        }
      }
      EXPECT_GT(near_edge, 20);  // the bound above was put to the test
    }
  }
}

TEST_P(PinholeProjection, CentroidAndDisparityAreSubPixel) {
  const auto renderer = Make(Plate());
  for (const double distance : {1.2, 1.71, 2.4}) {
    View view = LookAt({-distance, 0.03, 0.02}, {0, 0.03, 0.02}, 0.13);
    Picture left;
    Picture right;
    renderer->Grey(view, left);
    const base::Vec2 expected = Project(view, base::Vec3::Zero());
    EXPECT_LT((BrightCentroid(left) - expected).norm(), 0.05);
    view.X_WC = view.X_WC * base::Transform{base::Quat::Identity(), {0.11, 0, 0}};
    renderer->Grey(view, right);
    const base::Vec2 shift = BrightCentroid(left) - BrightCentroid(right);
    EXPECT_NEAR(shift.x(), view.intrinsics.fx * 0.11 / distance, 0.05);
    EXPECT_NEAR(shift.y(), 0.0, 0.05);
  }
}

TEST_P(PinholeProjection, RowsComeFromTheTopAndColumnsFromTheLeft) {
  worlds::World world = Plate();
  test::AddBox(world, {base::Quat::Identity(), {1.0, 3.0, 2.0}}, {0.1, 0.3, 0.3}, 0);  // left and up
  const auto renderer = Make(world);
  const View view = LookAt({-4, 0, 0}, {0, 0, 0});
  Picture picture;
  renderer->Grey(view, picture);
  const base::Vec2 at = Project(view, {0.9, 3.0, 2.0});
  EXPECT_LT(at.x(), 200);
  EXPECT_LT(at.y(), 160);
  EXPECT_GT(picture.bytes[static_cast<std::size_t>(std::lround(at.y()) * 640 + std::lround(at.x()))], 128);
}

TEST(Projection, BoxesBesideTheViewAreCulledAndSeenOnesKept) {
  const View view = LookAt({0, 0, 1}, {1, 0, 1});
  const internal::Frustum frustum = internal::FrustumOf(internal::ClipFromWorld(view));
  base::RandomStream random(3, "cull");
  int culled = 0;
  for (int i = 0; i < 3000; ++i) {
    const base::Vec3 p = test::RandomPose(random, {-20, -20, -20}, {20, 20, 20}).p;
    const bool kept = internal::MayBeVisible(frustum, p.cast<float>(), p.cast<float>());
    const base::Vec3 p_C = view.X_WC.Inverse() * p;
    const base::Vec2 uv = Project(view, p);
    const bool seen = p_C.z() > internal::kNear && p_C.z() < internal::kFar && uv.x() > -0.5 && uv.x() < 639.5 &&
                      uv.y() > -0.5 && uv.y() < 479.5;
    EXPECT_EQ(kept, seen);
    culled += kept ? 0 : 1;
  }
  EXPECT_GT(culled, 1500);
}

TEST(Projection, ImpossibleCamerasAreBadInput) {
  View view = LookAt({0, 0, 1}, {1, 0, 1});
  internal::CheckView(view);
  view.intrinsics.distortion[0] = 0.1;
  EXPECT_THROW(internal::CheckView(view), base::InputError);
  view.intrinsics.distortion[0] = 0.0;
  view.intrinsics.fx = 0.0;
  EXPECT_THROW(internal::CheckView(view), base::InputError);
  view.intrinsics.fx = 300.0;
  view.intrinsics.width = 0;
  EXPECT_THROW(internal::CheckView(view), base::InputError);
}

INSTANTIATE_TEST_SUITE_P(Makers, PinholeProjection, test::kEachMaker);

}  // namespace
}  // namespace alula::render
