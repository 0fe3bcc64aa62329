// The lens equations beside OpenCV's, and their inverses.
#include "stack/interface/camera_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/calib3d.hpp>

namespace alula::stack {
namespace {

using base::Vec2;
using base::Vec3;

CameraIntrinsics EurocLike() {
  return {752, 480, 458.654, 457.296, 367.215, 248.375, {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.011}};
}

CameraIntrinsics Fisheye() {
  return {640, 480, 190.9, 190.3, 319.1, 241.2, {0.0035, 0.0007, -0.002, 0.0002, 0.0}, DistortionModel::kEquidistant};
}

/// Directions up to `angle` rad from the axis.
std::vector<Vec3> Directions(double angle) {
  std::vector<Vec3> out;
  for (int ring = 0; ring <= 12; ++ring) {
    for (int spoke = 0; spoke < 8; ++spoke) {
      const double theta = angle * ring / 12;
      const double phi = 0.3 + spoke * M_PI / 4;
      out.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  }
  return out;
}

TEST(CameraModel, RadialTangentialIsOpenCvs) {
  const CameraIntrinsics k = EurocLike();
  const cv::Matx33d matrix(k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1);
  for (const Vec3& p : Directions(0.75)) {
    std::vector<cv::Point2d> pixel;
    cv::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, cv::Vec3d(), cv::Vec3d(), matrix,
                      std::vector<double>(k.distortion.begin(), k.distortion.end()), pixel);
    EXPECT_LT((Project(k, p) - Vec2(pixel[0].x, pixel[0].y)).norm(), 1e-9);
  }
}

TEST(CameraModel, EquidistantIsOpenCvsFisheye) {
  const CameraIntrinsics k = Fisheye();
  const cv::Matx33d matrix(k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1);
  for (const Vec3& p : Directions(1.4)) {  // OpenCV divides by z: in front of the camera only
    std::vector<cv::Point2d> pixel;
    cv::fisheye::projectPoints(std::vector<cv::Point3d>{{p.x(), p.y(), p.z()}}, pixel, cv::Vec3d(), cv::Vec3d(), matrix,
                               cv::Vec4d(k.distortion[0], k.distortion[1], k.distortion[2], k.distortion[3]));
    EXPECT_LT((Project(k, p) - Vec2(pixel[0].x, pixel[0].y)).norm(), 1e-6);
  }
}

TEST(CameraModel, RayTurnsProjectRound) {
  for (const auto& [k, angle] : {std::pair{EurocLike(), 0.75}, std::pair{Fisheye(), 1.9}}) {
    for (const Vec3& p : Directions(angle)) EXPECT_LT((Ray(k, Project(k, 3.0 * p)) - p).norm(), 1e-9);
  }
}

TEST(CameraModel, NormaliseTurnsDistortRound) {
  for (const CameraIntrinsics& k : {EurocLike(), Fisheye()}) {
    for (const Vec3& p : Directions(0.75)) {
      EXPECT_LT((Normalise(k, Project(k, p)) - p.hnormalized()).norm(), 1e-9);
      const Vec2 d = Distort(k, p.hnormalized());
      EXPECT_LT((Vec2(k.fx * d.x() + k.cx, k.fy * d.y() + k.cy) - Project(k, p)).norm(), 1e-9);
    }
  }
}

TEST(CameraModel, LargestAngleIsWhereTheRadiusStopsGrowing) {
  EXPECT_EQ(LargestAngle({640, 480, 400, 400, 319.5, 239.5, {}}), M_PI);
  // 1 + 3 k1 r² = 0.
  const CameraIntrinsics barrel{640, 480, 400, 400, 319.5, 239.5, {-0.3, 0, 0, 0, 0}};
  EXPECT_NEAR(LargestAngle(barrel), std::atan(std::sqrt(1 / 0.9)), 2e-3);
  const CameraIntrinsics folded{640, 480, 200, 200, 319.5, 239.5, {-0.2, 0, 0, 0, 0}, DistortionModel::kEquidistant};
  EXPECT_NEAR(LargestAngle(folded), std::sqrt(1 / 0.6), 2e-3);
}

}  // namespace
}  // namespace alula::stack
