#include "scenarios/report/video_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace alula::scenarios {

namespace {

constexpr int kChaseWidth = 848;
constexpr int kChaseHeight = 636;
constexpr int kSideX = kChaseWidth + 8;
constexpr int kSideWidth = VideoComposer::kWidth - kSideX;  // 424
constexpr int kCameraHeight = kSideWidth * 3 / 4;           // 318
constexpr int kMapY = kCameraHeight + 8;
constexpr int kMapHeight = kChaseHeight - kMapY;
constexpr double kChaseFieldOfView = 75.0 * M_PI / 180.0;  // horizontal

cv::Mat Wrap(Canvas& canvas) { return {canvas.height, canvas.width, CV_8UC3, canvas.rgb.data()}; }

stack::CameraIntrinsics ChaseIntrinsics() {
  stack::CameraIntrinsics k;
  k.width = kChaseWidth;
  k.height = kChaseHeight;
  k.fx = k.fy = 0.5 * kChaseWidth / std::tan(0.5 * kChaseFieldOfView);
  k.cx = 0.5 * (kChaseWidth - 1);
  k.cy = 0.5 * (kChaseHeight - 1);
  return k;
}

/// Old features green, young ones yellow, single-frame ones red.
cv::Scalar AgeColour(int age) {
  if (age <= 1) return {255, 80, 60};
  const double a = std::min(1.0, age / 30.0);
  return {255 * (1 - a), 220, 60};
}

void Write(cv::Mat& image, const std::string& text, int x, int y, double size, const cv::Scalar& colour) {
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, {0, 0, 0}, 3, cv::LINE_AA);
  cv::putText(image, text, {x, y}, cv::FONT_HERSHEY_SIMPLEX, size, colour, 1, cv::LINE_AA);
}

std::vector<render::Mover> WithActors(std::vector<render::Mover> movers, const worlds::World& world) {
  for (render::Mover& mover : render::MoversOf(world)) movers.push_back(std::move(mover));
  return movers;
}

}  // namespace

VideoComposer::VideoComposer(std::string_view maker, const worlds::World& world, std::vector<render::Mover> movers,
                             std::vector<base::Transform> X_BM, std::string title)
    : renderer_(render::MakeRenderer(maker, world, WithActors(std::move(movers), world))),
      X_BM_(std::move(X_BM)),
      title_(std::move(title)),
      chase_(world.bounds_low, world.bounds_high),
      map_(world, kSideWidth, kMapHeight) {}

const Canvas& VideoComposer::Compose(const VideoMoment& moment, base::Duration dt) {
  std::fill(canvas_.rgb.begin(), canvas_.rgb.end(), std::uint8_t{18});
  DrawChase(moment, dt);
  DrawCamera(moment);
  map_.AddTruth(moment.X_WB.p);
  if (moment.X_MB) map_.AddEstimate(moment.X_MB->p);
  map_.Draw(moment.view.get(), base::Yaw(moment.X_WB.q), moment.next_gate, canvas_, kSideX, kMapY);
  DrawText(moment);
  return canvas_;
}

void VideoComposer::DrawChase(const VideoMoment& moment, base::Duration dt) {
  std::vector<base::Transform> X_WM;
  for (const base::Transform& X_BM : X_BM_) X_WM.push_back(moment.X_WB * X_BM);
  X_WM.insert(X_WM.end(), moment.X_WL.begin(), moment.X_WL.end());
  renderer_->PlaceMovers(X_WM);
  render::View view;
  view.X_WC = chase_.Follow(moment.X_WB, dt);
  view.intrinsics = ChaseIntrinsics();
  renderer_->Colour(view, chase_picture_);
  cv::Mat target = Wrap(canvas_)(cv::Rect(0, 0, kChaseWidth, kChaseHeight));
  cv::Mat(kChaseHeight, kChaseWidth, CV_8UC3, chase_picture_.bytes.data()).copyTo(target);
}

void VideoComposer::DrawCamera(const VideoMoment& moment) {
  cv::Mat target = Wrap(canvas_)(cv::Rect(kSideX, 0, kSideWidth, kCameraHeight));
  if (!moment.left || !moment.left->bytes) {
    Write(target, "no camera", kSideWidth / 2 - 50, kCameraHeight / 2, 0.6, {150, 150, 150});
    return;
  }
  const stack::Image& left = *moment.left;
  const cv::Mat grey(left.height, left.width, CV_8UC1, const_cast<std::uint8_t*>(left.bytes->data()),
                     static_cast<std::size_t>(left.stride));
  cv::Mat small, colour;
  cv::resize(grey, small, target.size(), 0, 0, cv::INTER_AREA);
  cv::cvtColor(small, colour, cv::COLOR_GRAY2RGB);
  if (moment.view) {
    const double sx = static_cast<double>(kSideWidth) / left.width;
    const double sy = static_cast<double>(kCameraHeight) / left.height;
    for (const stack::FeatureView& f : moment.view->features) {
      cv::circle(colour, cv::Point2d((f.u + 0.5) * sx, (f.v + 0.5) * sy), 2, AgeColour(f.age), 1, cv::LINE_AA);
    }
    Write(colour, fmt::format("left camera, {} features", moment.view->features.size()), 8, kCameraHeight - 10, 0.45,
          {235, 235, 235});
  }
  colour.copyTo(target);
}

void VideoComposer::DrawText(const VideoMoment& moment) {
  cv::Mat image = Wrap(canvas_);
  const std::string gate = moment.gate_count == 0 ? ""
                           : moment.next_gate < moment.gate_count
                               ? fmt::format("gate {} of {}", moment.next_gate + 1, moment.gate_count)
                               : "all gates passed";
  Write(image, fmt::format("{:6.2f} s", moment.time.Seconds()), 16, kChaseHeight + 52, 1.1, {255, 255, 255});
  Write(image, fmt::format("{:4.2f} m/s", moment.v_WB.norm()), 230, kChaseHeight + 52, 1.1, {120, 230, 140});
  Write(image, gate, 470, kChaseHeight + 52, 1.1, {255, 200, 70});
  Write(image, moment.caption.substr(0, 52), kSideX, kChaseHeight + 32, 0.45, {220, 220, 220});
  Write(image, "truth", kSideX, kChaseHeight + 62, 0.45, {80, 220, 110});
  Write(image, "estimate", kSideX + 60, kChaseHeight + 62, 0.45, {255, 150, 40});
  Write(image, "plan", kSideX + 145, kChaseHeight + 62, 0.45, {90, 170, 255});
  Write(image, title_, 14, 26, 0.6, {255, 255, 255});
}

}  // namespace alula::scenarios
