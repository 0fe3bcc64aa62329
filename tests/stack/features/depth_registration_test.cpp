#include "stack/features/depth_registration.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "stack/interface/camera_model.h"
#include "tests/scenarios/dataset/synthetic.h"

namespace alula::stack::features {
namespace {

using base::Vec2;
using base::Vec3;

stack::CameraCalibration PinholeCamera(int width, int height, double f, const Vec3& p_BC, const base::Quat& q) {
  stack::CameraCalibration camera;
  camera.intrinsics = {.width = width, .height = height, .fx = f, .fy = f, .cx = 0.5 * width, .cy = 0.5 * height};
  camera.X_BC = {q, p_BC};
  return camera;
}

/// What a camera sees of a plane n·p_B = d, mm; 0 behind it.
stack::DepthImage SeePlane(const stack::CameraCalibration& camera, const Vec3& n, double d) {
  const stack::CameraIntrinsics& c = camera.intrinsics;
  std::vector<std::uint16_t> depth;
  for (int v = 0; v < c.height; ++v) {
    for (int u = 0; u < c.width; ++u) {
      const Vec2 xy = stack::Normalise(c, Vec2(u, v));
      const double z = (d - n.dot(camera.X_BC.p)) / n.dot(camera.X_BC.q * Vec3(xy.x(), xy.y(), 1));
      depth.push_back(z > 0 && z < 60 ? static_cast<std::uint16_t>(std::lround(1000 * z)) : std::uint16_t{0});
    }
  }
  return {.width = c.width,
          .height = c.height,
          .exposure_start = base::Time{42},
          .exposure = {},
          .millimetres = std::make_shared<const std::vector<std::uint16_t>>(std::move(depth))};
}

const base::Quat kAhead = base::Quat::Identity();  // B's axes are taken as the cameras'

TEST(DepthRegistration, TheSameCameraSeesTheSame) {
  stack::CameraCalibration camera =
      scenarios::dataset::testing::Camera(30, "depth", stack::CameraKind::kDepth);  // with a lens
  EXPECT_TRUE(Registered(camera, camera));
  base::RandomStream random(1, "depth");
  std::vector<std::uint16_t> depth;
  const auto& c = camera.intrinsics;
  for (int i = 0; i < c.width * c.height; ++i) depth.push_back(static_cast<std::uint16_t>(random.Index(20'000)));
  const stack::DepthImage image{.width = c.width,
                                .height = c.height,
                                .exposure_start = {},
                                .exposure = {},
                                .millimetres = std::make_shared<const std::vector<std::uint16_t>>(depth)};
  EXPECT_EQ(*DepthRegistration(camera, camera)(image).millimetres, depth);
  stack::CameraCalibration other = camera;
  other.X_BC.p.x() += 1e-3;
  EXPECT_FALSE(Registered(camera, other));
  other = camera;
  other.intrinsics.fx += 0.1;
  EXPECT_FALSE(Registered(camera, other));
}

/// A slanted plane has a closed form in every camera: what registration gives is that, to the rounding of depth and
/// half a pixel of slant.
TEST(DepthRegistration, APlaneIsSeenFromTheOtherCamera) {
  const Vec3 n = Vec3(0.2, -0.3, 1).normalized();
  constexpr double kDistance = 3;
  const stack::CameraCalibration depth = PinholeCamera(160, 120, 146, {0, 0, 0}, kAhead);
  for (const double f : {131.0, 146.0, 200.0, 400.0}) {  // coarser, as fine, finer: no holes in any
    const stack::CameraCalibration colour =
        PinholeCamera(160, 120, f, {0.025, -0.003, 0.01}, base::FromYawPitchRoll(0.01, -0.02, 0.015));
    const stack::DepthImage seen = DepthRegistration(depth, colour)(SeePlane(depth, n, kDistance));
    const stack::DepthImage wanted = SeePlane(colour, n, kDistance);
    EXPECT_EQ(seen.exposure_start, base::Time{42});
    int compared = 0;
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        const std::size_t i = static_cast<std::size_t>(v * 160 + u);
        // Where the depth camera looks too, two pixels inside.
        const Vec2 xy = stack::Normalise(colour.intrinsics, Vec2(u, v));
        const double z = 1e-3 * (*wanted.millimetres)[i];
        const Vec3 p_B = colour.X_BC * Vec3(z * xy.x(), z * xy.y(), z);
        if (p_B.z() <= 0 || !stack::Inside(depth.intrinsics, stack::Project(depth.intrinsics, p_B), 2)) continue;
        ++compared;
        ASSERT_GT((*seen.millimetres)[i], 0) << f << " " << u << " " << v;
        // A pixel's slant: dz = z · (1/f) · |∇| · (half a pixel of either camera, both ways), at most 1.5 px here.
        ASSERT_NEAR((*seen.millimetres)[i], 1e3 * z, 1.5 * 1e3 * z * z / kDistance * 0.5 / 131 + 1) << u << " " << v;
      }
    }
    EXPECT_GT(compared, f > 300 ? 15'000 : 8000);
  }
}

TEST(DepthRegistration, TheNearerOfTwoIsSeenAndWhatIsHiddenStaysEmpty) {
  const stack::CameraCalibration depth = PinholeCamera(100, 20, 100, {0, 0, 0}, kAhead);
  const stack::CameraCalibration colour = PinholeCamera(100, 20, 100, {0.1, 0, 0}, kAhead);
  // A wall at 4 m and before its columns 40 to 59 a board at 1 m.
  std::vector<std::uint16_t> mm(2000, 4000);
  for (int v = 0; v < 20; ++v) {
    for (int u = 40; u < 60; ++u) mm[static_cast<std::size_t>(v * 100 + u)] = 1000;
  }
  const stack::DepthImage seen =
      DepthRegistration(depth, colour)({.width = 100,
                                        .height = 20,
                                        .exposure_start = {},
                                        .exposure = {},
                                        .millimetres = std::make_shared<const std::vector<std::uint16_t>>(mm)});
  // Seen from 0.1 m to the right the board lies 10 px further left, the wall 2.5 px.
  const auto at = [&](int u) { return (*seen.millimetres)[static_cast<std::size_t>(10 * 100 + u)]; };
  for (int u = 30; u < 50; ++u) EXPECT_EQ(at(u), 1000) << u;
  for (int u = 0; u < 30; ++u) EXPECT_EQ(at(u), 4000) << u;
  for (int u = 58; u < 97; ++u) EXPECT_EQ(at(u), 4000) << u;
  for (int u = 51; u < 57; ++u) EXPECT_EQ(at(u), 0) << u;  // the wall that the board hid from the depth camera
  EXPECT_EQ(at(99), 0);                                    // beyond its border
}

TEST(DepthRegistration, RefusesAnotherSize) {
  const stack::CameraCalibration camera = PinholeCamera(10, 10, 10, {0, 0, 0}, kAhead);
  EXPECT_THROW(DepthRegistration(camera, camera)(SeePlane(PinholeCamera(9, 10, 10, {0, 0, 0}, kAhead), {0, 0, 1}, 1)),
               base::FaultError);
}

}  // namespace
}  // namespace alula::stack::features
