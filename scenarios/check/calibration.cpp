#include "scenarios/check/calibration.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

#include "base/error.h"
#include "scenarios/check/board_poses.h"
#include "scenarios/check/check_worlds.h"

namespace alula::scenarios::check {
namespace {

using base::Vec2;
bool IsFisheye(stack::DistortionModel model) { return model == stack::DistortionModel::kEquidistant; }
constexpr int kCorners = Board::kColumns * Board::kRows;

using Points2 = std::vector<std::vector<cv::Point2d>>;
using Points3 = std::vector<std::vector<cv::Point3d>>;

std::vector<cv::Point3d> BoardPoints() {
  std::vector<cv::Point3d> points;
  for (int n = 0; n < kCorners; ++n) {
    const base::Vec3 p = BoardCorner(n);
    points.emplace_back(p.x(), p.y(), p.z());
  }
  return points;
}

/// calibrateCamera wants single precision, the fisheye functions take double.
template <typename To, typename From>
std::vector<std::vector<To>> Convert(const std::vector<std::vector<From>>& from) {
  std::vector<std::vector<To>> to;
  for (const auto& list : from) to.emplace_back(list.begin(), list.end());
  return to;
}

Points2 PixelsOf(const std::vector<std::vector<Vec2>>& views) {
  Points2 all;
  for (const std::vector<Vec2>& view : views) {
    all.emplace_back();
    for (const Vec2& p : view) all.back().emplace_back(p.x(), p.y());
  }
  return all;
}

cv::Mat MatrixOf(const stack::CameraIntrinsics& k) {
  return (cv::Mat_<double>(3, 3) << k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1);
}
cv::Mat DistortionOf(const stack::CameraIntrinsics& k) {
  return cv::Mat(1, IsFisheye(k.model) ? 4 : 5, CV_64F, const_cast<double*>(k.distortion.data())).clone();
}

base::Transform TransformOf(const cv::Mat& rotation_vector, const cv::Mat& translation) {
  cv::Mat r, t;
  rotation_vector.reshape(1, 3).convertTo(r, CV_64F);
  translation.reshape(1, 3).convertTo(t, CV_64F);
  return {base::Exp({r.at<double>(0), r.at<double>(1), r.at<double>(2)}),
          {t.at<double>(0), t.at<double>(1), t.at<double>(2)}};
}

int BrownFlags(const LensKind& kind) {
  int flags = 0;
  if (!kind.free[0]) flags |= cv::CALIB_FIX_K1;
  if (!kind.free[1]) flags |= cv::CALIB_FIX_K2;
  if (!kind.free[2] && !kind.free[3]) flags |= cv::CALIB_ZERO_TANGENT_DIST;
  if (!kind.free[4]) flags |= cv::CALIB_FIX_K3;
  return flags;
}
int FisheyeFlags(const LensKind& kind) {
  int flags = cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW;
  constexpr int kFix[] = {cv::fisheye::CALIB_FIX_K1, cv::fisheye::CALIB_FIX_K2, cv::fisheye::CALIB_FIX_K3,
                          cv::fisheye::CALIB_FIX_K4};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!kind.free[i]) flags |= kFix[i];
  }
  return flags;
}

/// Pixels of the board from a pose and their derivatives: 2N × (rotation 3, translation 3, fx fy cx cy, coefficients).
struct Projected {
  Eigen::VectorXd pixels;
  Eigen::MatrixXd by_pose, by_camera;
};
Projected ProjectWithJacobian(const stack::CameraIntrinsics& k, const cv::Mat& rvec, const cv::Mat& tvec) {
  std::vector<cv::Point2d> pixels;
  cv::Mat J;
  const int coefficients = IsFisheye(k.model) ? 4 : 5;
  int pose = 0, optics = 6;
  if (IsFisheye(k.model)) {  // columns: f 2, c 2, k 4, rotation 3, translation 3, skew
    cv::fisheye::projectPoints(BoardPoints(), pixels, rvec, tvec, MatrixOf(k), DistortionOf(k), 0, J);
    pose = 8, optics = 0;
  } else {  // columns: rotation 3, translation 3, f 2, c 2, coefficients
    cv::projectPoints(BoardPoints(), rvec, tvec, MatrixOf(k), DistortionOf(k), pixels, J);
  }
  Projected out;
  out.pixels.resize(2 * kCorners);
  Eigen::MatrixXd all(J.rows, J.cols);
  for (int r = 0; r < J.rows; ++r) {
    for (int c = 0; c < J.cols; ++c) all(r, c) = J.at<double>(r, c);
  }
  for (int n = 0; n < kCorners; ++n) out.pixels.segment<2>(2 * n) << pixels[n].x, pixels[n].y;
  out.by_pose = all.middleCols(pose, 6);
  out.by_camera = all.middleCols(optics, 4 + coefficients);
  return out;
}

/// Residuals, and the information on the camera alone.
void AddErrors(const LensKind& kind, const Points2& views, const std::vector<cv::Mat>& rvecs,
               const std::vector<cv::Mat>& tvecs, CalibratedCamera& camera) {
  std::vector<int> free{0, 1, 2, 3};
  for (int i = 0; i < 5; ++i) {
    if (kind.free[i]) free.push_back(4 + i);
  }
  const auto unknowns = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(unknowns, unknowns);
  double squares = 0.0, rows = 0.0;
  for (std::size_t view = 0; view < views.size(); ++view) {
    const Projected p = ProjectWithJacobian(camera.intrinsics, rvecs[view], tvecs[view]);
    for (int n = 0; n < kCorners; ++n) {
      squares += (p.pixels.segment<2>(2 * n) - Vec2(views[view][n].x, views[view][n].y)).squaredNorm();
    }
    rows += 2.0 * kCorners;
    Eigen::MatrixXd A(p.by_camera.rows(), unknowns);
    for (Eigen::Index i = 0; i < unknowns; ++i) A.col(i) = p.by_camera.col(free[i]);
    const Eigen::MatrixXd cross = A.transpose() * p.by_pose;
    const base::Mat6 own = p.by_pose.transpose() * p.by_pose;
    information += A.transpose() * A - cross * own.ldlt().solve(cross.transpose());
  }
  camera.rmse = std::sqrt(squares / (0.5 * rows));
  const double freedom = rows - static_cast<double>(unknowns) - 6.0 * static_cast<double>(views.size());
  // Scaled to a unit diagonal: focal lengths and coefficients differ by powers of ten.
  const Eigen::VectorXd scale = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd unit = scale.asDiagonal() * information * scale.asDiagonal();
  const Eigen::MatrixXd covariance = scale.asDiagonal() * unit.inverse() * scale.asDiagonal() * (squares / freedom);
  for (Eigen::Index i = 0; i < unknowns; ++i) {
    const double sigma = std::sqrt(covariance(i, i));
    free[i] < 4 ? camera.optics_sigma[free[i]] = sigma : camera.distortion_sigma[free[i] - 4] = sigma;
  }
}

std::vector<Vec2> Corners(const std::vector<cv::Point2f>& points) {
  std::vector<Vec2> corners;
  for (const cv::Point2f& point : points) corners.emplace_back(point.x, point.y);
  return corners;
}

/// Smallest distance between neighbours in a row or a column, px.
double Spacing(const std::vector<Vec2>& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (int n = 0; n < kCorners; ++n) {
    if (n % Board::kColumns > 0) least = std::min(least, (corners[n] - corners[n - 1]).norm());
    if (n >= Board::kColumns) least = std::min(least, (corners[n] - corners[n - Board::kColumns]).norm());
  }
  return least;
}

}  // namespace

std::optional<std::vector<Vec2>> FindBoard(const Frame& frame, const std::vector<Vec2>& expected) {
  const cv::Mat image(frame.height, frame.width, CV_8UC1, const_cast<std::uint8_t*>(frame.grey.data()));
  // Squares of few pixels are not found; pixel u lies at 2 u + ½ of a picture twice as large.
  constexpr double kSmall = 11.0;  // px
  const double scale = Spacing(expected) < kSmall ? 2.0 : 1.0;
  cv::Mat enlarged = image;
  if (scale > 1.0) cv::resize(image, enlarged, {}, scale, scale, cv::INTER_CUBIC);
  std::vector<cv::Point2f> corners;
  if (!cv::findChessboardCorners(enlarged, {Board::kColumns, Board::kRows}, corners)) return std::nullopt;
  for (cv::Point2f& corner : corners) {
    corner = (corner - cv::Point2f(1.0F, 1.0F) * static_cast<float>(0.5 * (scale - 1.0))) / scale;
  }
  const int half = std::clamp(static_cast<int>(0.4 * Spacing(Corners(corners))), 2, 10);
  cv::cornerSubPix(image, corners, {half, half}, {-1, -1}, {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 60, 1e-4});
  std::vector<Vec2> found = Corners(corners);
  double straight = 0.0, reversed = 0.0;
  for (std::size_t n = 0; n < found.size(); ++n) {
    straight += (found[n] - expected[n]).squaredNorm();
    reversed += (found[found.size() - 1 - n] - expected[n]).squaredNorm();
  }
  if (reversed < straight) std::reverse(found.begin(), found.end());
  return found;
}

CalibratedCamera CalibrateCamera(const LensKind& kind, const std::vector<std::vector<Vec2>>& views) {
  const Points2 pixels = PixelsOf(views);
  const Points3 points(views.size(), BoardPoints());
  cv::Mat matrix, distortion;
  std::vector<cv::Mat> rvecs, tvecs;
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-12);
  try {
    if (IsFisheye(kind.model)) {
      cv::fisheye::calibrate(points, pixels, {kind.width, kind.height}, matrix, distortion, rvecs, tvecs,
                             FisheyeFlags(kind), until);
    } else {
      cv::calibrateCamera(Convert<cv::Point3f>(points), Convert<cv::Point2f>(pixels), {kind.width, kind.height}, matrix,
                          distortion, rvecs, tvecs, BrownFlags(kind), until);
    }
  } catch (const cv::Exception& e) {
    throw base::FaultError("calibration", e.err);
  }
  CalibratedCamera camera;
  camera.intrinsics = {.width = kind.width,
                       .height = kind.height,
                       .fx = matrix.at<double>(0, 0),
                       .fy = matrix.at<double>(1, 1),
                       .cx = matrix.at<double>(0, 2),
                       .cy = matrix.at<double>(1, 2),
                       .distortion = {},
                       .model = kind.model};
  for (int i = 0; i < (IsFisheye(kind.model) ? 4 : 5); ++i) camera.intrinsics.distortion[i] = distortion.at<double>(i);
  for (std::size_t view = 0; view < views.size(); ++view) {
    camera.X_CT.push_back(TransformOf(rvecs[view], tvecs[view]));
  }
  AddErrors(kind, pixels, rvecs, tvecs, camera);
  return camera;
}

base::Transform CalibratePair(const stack::CameraIntrinsics& first, const stack::CameraIntrinsics& second,
                              const std::vector<std::vector<Vec2>>& views_first,
                              const std::vector<std::vector<Vec2>>& views_second) {
  const Points2 one = PixelsOf(views_first), two = PixelsOf(views_second);
  const Points3 points(views_first.size(), BoardPoints());
  cv::Mat K1 = MatrixOf(first), D1 = DistortionOf(first), K2 = MatrixOf(second), D2 = DistortionOf(second), R, T, E, F;
  const cv::Size size(first.width, first.height);
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-12);
  try {
    if (IsFisheye(first.model)) {
      cv::fisheye::stereoCalibrate(points, one, two, K1, D1, K2, D2, size, R, T, cv::fisheye::CALIB_FIX_INTRINSIC,
                                   until);
    } else {
      cv::stereoCalibrate(Convert<cv::Point3f>(points), Convert<cv::Point2f>(one), Convert<cv::Point2f>(two), K1, D1,
                          K2, D2, size, R, T, E, F, cv::CALIB_FIX_INTRINSIC, until);
    }
  } catch (const cv::Exception& e) {
    throw base::FaultError("calibration", e.err);
  }
  cv::Mat rotation;
  cv::Rodrigues(R, rotation);
  return TransformOf(rotation, T).Inverse();  // OpenCV gives the first camera in the second one
}

}  // namespace alula::scenarios::check
