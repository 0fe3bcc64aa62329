#include "scenarios/report/map_view.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "geometry/shape.h"

namespace alula::scenarios {

namespace {

const cv::Scalar kGround(38, 40, 44);
const cv::Scalar kObstacle(112, 114, 118);
const cv::Scalar kGateColour(235, 200, 60);
const cv::Scalar kNextGate(255, 90, 60);
const cv::Scalar kTruth(80, 220, 110);
const cv::Scalar kEstimate(255, 150, 40);
const cv::Scalar kPlan(90, 170, 255);
constexpr double kGroundHeight = 0.1;  // objects no higher than this are ground, m
constexpr int kShift = 3;              // sub-pixel bits of OpenCV's drawing

struct Pen {
  cv::Mat image;
  double px_per_m, x0, y1, margin_x, margin_y;

  cv::Point At(const base::Vec3& p) const {
    constexpr double kUnit = 1 << kShift;
    return {static_cast<int>(std::lround((margin_x + (p.x() - x0) * px_per_m) * kUnit)),
            static_cast<int>(std::lround((margin_y + (y1 - p.y()) * px_per_m) * kUnit))};
  }
  void Line(const base::Vec3& a, const base::Vec3& b, const cv::Scalar& colour, int thickness) {
    cv::line(image, At(a), At(b), colour, thickness, cv::LINE_AA, kShift);
  }
  void Trail(const std::vector<base::Vec3>& points, const cv::Scalar& colour, int thickness) {
    for (std::size_t i = 1; i < points.size(); ++i) Line(points[i - 1], points[i], colour, thickness);
  }
};

/// Outline of an object seen from above, or nothing for ground.
void DrawFootprint(const worlds::Object& object, Pen& pen) {
  const geometry::Mesh mesh = geometry::Tessellate(object.shape, 1.0, 12);
  std::vector<cv::Point> points;
  double top = -1e9;
  for (const geometry::Mesh::Vertex& v : mesh.vertices) {
    const base::Vec3 p = object.X_WO * v.position.cast<double>();
    top = std::max(top, p.z());
    points.push_back(pen.At(p));
  }
  if (top < kGroundHeight || points.size() < 3) return;
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  cv::fillConvexPoly(pen.image, hull, kObstacle, cv::LINE_AA, kShift);
}

/// Blue low, green middle, red high, as height over 0–3 m.
cv::Scalar HeightColour(double z) {
  const double h = std::clamp(z / 3.0, 0.0, 1.0);
  return {60 + 160 * std::max(0.0, 2 * h - 1), 60 + 140 * (1 - std::abs(2 * h - 1)),
          60 + 160 * std::max(0.0, 1 - 2 * h)};
}

void DrawVehicle(const base::Vec3& p, double yaw, Pen& pen) {
  const base::Vec3 forward(std::cos(yaw), std::sin(yaw), 0);
  const base::Vec3 left(-forward.y(), forward.x(), 0);
  const std::vector<cv::Point> triangle = {pen.At(p + 0.55 * forward), pen.At(p - 0.35 * forward + 0.35 * left),
                                           pen.At(p - 0.35 * forward - 0.35 * left)};
  cv::fillConvexPoly(pen.image, triangle, cv::Scalar(255, 255, 255), cv::LINE_AA, kShift);
}

}  // namespace

MapView::MapView(const worlds::World& world, int width, int height)
    : width_(width), height_(height), gates_(world.gates), target_(world.target) {
  const base::Vec3 size = world.bounds_high - world.bounds_low;
  scale_.px_per_m = std::min((width - 16) / size.x(), (height - 16) / size.y());
  scale_.x0 = world.bounds_low.x();
  scale_.y1 = world.bounds_high.y();
  scale_.margin_x = 0.5 * (width - size.x() * scale_.px_per_m);
  scale_.margin_y = 0.5 * (height - size.y() * scale_.px_per_m);
  cv::Mat image(height, width, CV_8UC3, kGround);
  Pen pen{image, scale_.px_per_m, scale_.x0, scale_.y1, scale_.margin_x, scale_.margin_y};
  for (const worlds::Object& object : world.objects) DrawFootprint(object, pen);
  background_.assign(image.data, image.data + image.total() * 3);
}

void MapView::Draw(const stack::StackView* view, double yaw, int next_gate, Canvas& canvas, int x, int y) const {
  cv::Mat whole(canvas.height, canvas.width, CV_8UC3, canvas.rgb.data());
  cv::Mat image = whole(cv::Rect(x, y, width_, height_));
  cv::Mat(height_, width_, CV_8UC3, const_cast<std::uint8_t*>(background_.data())).copyTo(image);
  Pen pen{image, scale_.px_per_m, scale_.x0, scale_.y1, scale_.margin_x, scale_.margin_y};
  if (view != nullptr) {
    const int half = std::max(1, static_cast<int>(std::lround(0.5 * view->cell * scale_.px_per_m)));
    for (const Eigen::Vector3f& cell : view->occupied_O) {
      const base::Vec3 p = view->X_MO * cell.cast<double>();
      if (p.z() < 0.2) continue;  // the ground would cover everything
      const cv::Point c = pen.At(p);
      const cv::Point centre(c.x >> kShift, c.y >> kShift);
      cv::rectangle(image, centre - cv::Point(half, half), centre + cv::Point(half - 1, half - 1), HeightColour(p.z()),
                    cv::FILLED);
    }
  }
  for (std::size_t i = 0; i < gates_.size(); ++i) {
    const worlds::Gate& gate = gates_[i];
    const base::Vec3 side = gate.X_WG.q * base::Vec3(0, 0.5 * gate.opening + gate.frame, 0);
    const cv::Scalar& colour = static_cast<int>(i) == next_gate ? kNextGate : kGateColour;
    pen.Line(gate.X_WG.p - side, gate.X_WG.p + side, colour, 3);
    pen.Line(gate.X_WG.p, gate.X_WG * base::Vec3(0.8, 0, 0), colour, 1);
  }
  cv::circle(image, pen.At(target_), 6 << kShift, kNextGate, 1, cv::LINE_AA, kShift);
  if (view != nullptr && !view->path_O.empty()) {
    std::vector<base::Vec3> plan;
    for (const base::Vec3& p : view->path_O) plan.push_back(view->X_MO * p);
    pen.Trail(plan, kPlan, 2);
  }
  pen.Trail(estimate_, kEstimate, 1);
  pen.Trail(truth_, kTruth, 1);
  if (!truth_.empty()) DrawVehicle(truth_.back(), yaw, pen);
}

}  // namespace alula::scenarios
