#include "tests/scenarios/dataset/reprojection.h"

#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>
#include <stdexcept>

#include "scenarios/dataset/euroc_reader.h"
#include "scenarios/dataset/image_file.h"
#include "stack/interface/camera_model.h"

namespace alula::scenarios::dataset::testing {
namespace {

using base::Vec2;
using base::Vec3;
using Points = std::vector<cv::Point2f>;

cv::Mat Load(const Recording& recording, std::size_t eye, std::size_t frame) {
  const stack::Image image = LoadImage(recording.images[eye][frame], recording.calibration.cameras[eye]);
  return cv::Mat(image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.bytes->data()),
                 static_cast<std::size_t>(image.stride))
      .clone();
}

/// Points of `a` in `b`; those that do not come back are marked.
Points Follow(const cv::Mat& a, const cv::Mat& b, const Points& from, std::vector<bool>& good) {
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 0.005);
  Points to, back;
  std::vector<std::uint8_t> there, here;
  std::vector<float> error;
  if (from.empty()) return to;
  cv::calcOpticalFlowPyrLK(a, b, from, to, there, error, cv::Size(21, 21), 4, until);
  cv::calcOpticalFlowPyrLK(b, a, to, back, here, error, cv::Size(21, 21), 4, until);
  for (std::size_t i = 0; i < from.size(); ++i) {
    const bool inside = to[i].x > 12 && to[i].y > 12 && to[i].x < static_cast<float>(b.cols) - 12 &&
                        to[i].y < static_cast<float>(b.rows) - 12;
    good[i] = good[i] && there[i] && here[i] && inside && cv::norm(from[i] - back[i]) < 0.5;
  }
  return to;
}

/// Pose of a camera at one of its frames: ground truth at the stamp, interpolated between its rows, and sensor.yaml.
base::Transform CameraPose(const Recording& recording, std::size_t eye, std::size_t frame) {
  const stack::CameraCalibration& camera = recording.calibration.cameras[eye];
  const base::Time time = recording.images[eye][frame].captured + camera.time_offset;
  const auto after = std::lower_bound(recording.truth.begin(), recording.truth.end(), time,
                                      [](const BodyTruth& truth, base::Time t) { return truth.time < t; });
  if (after == recording.truth.end()) throw std::runtime_error("an image after the last ground truth");
  if (after == recording.truth.begin()) return after->X_WB * camera.X_BC;
  const BodyTruth &a = *(after - 1), &b = *after;
  const double s = (time - a.time).Seconds() / (b.time - a.time).Seconds();
  const base::Transform X_WB{a.X_WB.q.slerp(s, b.X_WB.q), (1 - s) * a.X_WB.p + s * b.X_WB.p};
  return X_WB * camera.X_BC;
}

/// The projection of a point into one sighting's camera.
struct View {
  const stack::CameraIntrinsics* intrinsics;
  base::Transform X_CW;
  const Sighting* sighting;

  std::optional<Vec2> Project(const Vec3& p_W) const {
    const Vec3 p_C = X_CW * p_W;
    if (p_C.z() < 0.1) return std::nullopt;
    return stack::Project(*intrinsics, p_C);
  }
};

/// The point nearest to all rays, then Gauss–Newton on the reprojection errors; none where the rays are parallel or it
/// falls behind a camera.
std::optional<Vec3> Triangulate(const std::vector<View>& views) {
  base::Mat3 A = base::Mat3::Zero();
  Vec3 b = Vec3::Zero();
  for (const View& view : views) {
    const base::Transform X_WC = view.X_CW.Inverse();
    const Vec3 ray = X_WC.q * stack::Ray(*view.intrinsics, view.sighting->pixel);
    const base::Mat3 across = base::Mat3::Identity() - ray * ray.transpose();
    A += across;
    b += across * X_WC.p;
  }
  Vec3 p = A.ldlt().solve(b);
  for (int round = 0; round < 8; ++round) {
    base::Mat3 H = base::Mat3::Zero();
    Vec3 g = Vec3::Zero();
    for (const View& view : views) {
      constexpr double kStep = 1e-5;
      const auto at = view.Project(p);
      if (!at) return std::nullopt;
      Eigen::Matrix<double, 2, 3> J;
      for (int k = 0; k < 3; ++k) {
        const auto moved = view.Project(p + kStep * Vec3::Unit(k));
        if (!moved) return std::nullopt;
        J.col(k) = (*moved - *at) / kStep;
      }
      H += J.transpose() * J;
      g += J.transpose() * (view.sighting->pixel - *at);
    }
    p += H.ldlt().solve(g);
    if (!p.allFinite()) return std::nullopt;
  }
  return p;
}

double Median(std::vector<double>& values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<Track> FollowCorners(const Recording& recording, std::size_t stride, std::size_t length) {
  cv::setNumThreads(1);
  const std::size_t frames = std::min(recording.images[0].size(), recording.images[1].size());
  std::vector<Track> tracks;
  for (std::size_t first = 0; first + length < frames; first += stride) {
    cv::Mat left = Load(recording, 0, first);
    Points points;
    cv::goodFeaturesToTrack(left, points, 150, 0.02, 15);
    std::vector<Track> started(points.size());
    std::vector<bool> alive(points.size(), true);
    for (std::size_t frame = first; frame <= first + length; ++frame) {
      if (frame > first) {
        const cv::Mat next = Load(recording, 0, frame);
        points = Follow(left, next, points, alive);
        left = next;
      }
      std::vector<bool> in_both = alive;
      const Points right = Follow(left, Load(recording, 1, frame), points, in_both);
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (alive[i]) started[i].push_back({0, frame, {points[i].x, points[i].y}});
        if (in_both[i]) started[i].push_back({1, frame, {right[i].x, right[i].y}});
      }
    }
    tracks.insert(tracks.end(), started.begin(), started.end());
  }
  return tracks;
}

ReprojectionFigures Reproject(const Recording& recording, const std::vector<Track>& tracks) {
  std::array<std::vector<double>, 2> errors;
  ReprojectionFigures figures;
  for (const Track& track : tracks) {
    if (track.size() < 6) continue;  // three pairs
    std::vector<View> views;
    for (const Sighting& sighting : track) {
      const auto eye = static_cast<std::size_t>(sighting.eye);
      views.push_back({&recording.calibration.cameras[eye].intrinsics,
                       CameraPose(recording, eye, sighting.frame).Inverse(), &sighting});
    }
    const std::optional<Vec3> p_W = Triangulate(views);
    if (!p_W) continue;
    ++figures.landmarks;
    for (const View& view : views) {
      const auto pixel = view.Project(*p_W);
      if (!pixel) continue;
      errors[static_cast<std::size_t>(view.sighting->eye)].push_back((*pixel - view.sighting->pixel).norm());
    }
  }
  for (std::size_t eye = 0; eye < 2; ++eye) {
    figures.sightings[eye] = errors[eye].size();
    figures.median[eye] = Median(errors[eye]);
  }
  return figures;
}

}  // namespace alula::scenarios::dataset::testing
