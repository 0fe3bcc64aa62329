// Depth from whatever a rig has.
#include <gtest/gtest.h>

#include "stack/features/keypoint_depth.h"
#include "stack/features/stereo_rig.h"

namespace alula::stack::features {
namespace {

using base::Vec2;

DepthImage Flat(std::uint16_t mm) {
  DepthImage depth;
  depth.width = 20;
  depth.height = 10;
  depth.millimetres = std::make_shared<const std::vector<std::uint16_t>>(200, mm);
  return depth;
}
DepthImage With(const DepthImage& depth, const std::vector<Vec2>& pixels, std::uint16_t mm) {
  auto changed = std::make_shared<std::vector<std::uint16_t>>(*depth.millimetres);
  for (const Vec2& p : pixels) (*changed)[static_cast<std::size_t>(p.y() * 20 + p.x())] = mm;
  DepthImage copy = depth;
  copy.millimetres = std::move(changed);
  return copy;
}

TEST(DepthAt, IsThatOfTheNeighbourhood) {
  EXPECT_EQ(DepthAt(Flat(2500), {7.4, 3.6}), 2.5);
  EXPECT_EQ(DepthAt(Flat(2500), {0.0, 0.0}), std::nullopt);  // a corner of the image has four pixels around it
  EXPECT_EQ(DepthAt(Flat(2500), {5.0, 0.0}), 2.5);           // its edge six
  EXPECT_EQ(DepthAt(Flat(0), {7, 3}), std::nullopt);
  EXPECT_EQ(DepthAt(With(Flat(2500), {{7, 3}, {8, 3}}, 0), {7, 3}), 2.5);                      // holes
  EXPECT_EQ(DepthAt(With(Flat(2500), {{8, 2}, {8, 3}, {8, 4}}, 3000), {7, 3}), std::nullopt);  // an edge runs by
}

TEST(VirtualRight, LiesAtThePairsDisparity) {
  CameraCalibration camera;
  camera.intrinsics = {.width = 640, .height = 480, .fx = 500, .fy = 500, .cx = 320, .cy = 240};
  camera.intrinsics.distortion[0] = -0.2;
  const StereoRig rig = MakeRig(camera, 0.8);
  EXPECT_EQ(rig.depth, DepthSource::kDepthCamera);
  const Vec2 left(0.3, -0.2), right = VirtualRight(rig, left, 4.0);
  EXPECT_NEAR((left - right).x(), 0.8 / 4.0, 1e-12);
  EXPECT_NEAR((left - right).y(), 0.0, 1e-12);
  EXPECT_NEAR(TriangulatedDepth(rig.X_LR, left, right), 4.0, 1e-9);
  EXPECT_EQ(MakeRig(camera, std::nullopt).depth, DepthSource::kNone);
}

TEST(KeypointDepths, AreReadFromTheDepthImageOrAreNone) {
  CameraCalibration camera;
  camera.intrinsics = {.width = 20, .height = 10, .fx = 20, .fy = 20, .cx = 10, .cy = 5};
  const std::vector<Vec2> pixels{{5, 5}, {0, 0}};
  const auto depths = KeypointDepths(MakeRig(camera, 1.0), {}, {}, Flat(1200), pixels);
  EXPECT_EQ(depths, (std::vector<std::optional<double>>{1.2, std::nullopt}));
  const std::vector<std::optional<double>> none(2);
  EXPECT_EQ(KeypointDepths(MakeRig(camera, 1.0), {}, {}, DepthImage{}, pixels), none);
  EXPECT_EQ(KeypointDepths(MakeRig(camera, std::nullopt), {}, {}, Flat(1200), pixels), none);
}

}  // namespace
}  // namespace alula::stack::features
