#include "render/passes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "render/internal/projection.h"

namespace alula::render {
namespace {

template <typename Picture>
void CheckSize(const View& view, const Picture& picture, std::size_t pixels) {
  const stack::CameraIntrinsics& k = view.intrinsics;
  if (picture.width != k.width || picture.height != k.height ||
      pixels != static_cast<std::size_t>(k.width) * static_cast<std::size_t>(k.height)) {
    throw base::FaultError("render", "a picture of " + std::to_string(picture.width) + " x " +
                                         std::to_string(picture.height) + " for a view of " + std::to_string(k.width) +
                                         " x " + std::to_string(k.height));
  }
}

/// From points in the first camera's axes to those in the second's: of the statics, then of each mover.
std::vector<base::Transform> MotionsOf(const Moment& first, const Moment& second) {
  if (first.X_WM.size() != second.X_WM.size()) {
    throw base::FaultError("render", "poses of " + std::to_string(first.X_WM.size()) + " movers, then of " +
                                         std::to_string(second.X_WM.size()));
  }
  const base::Transform X_C2W = second.view.X_WC.Inverse();
  std::vector<base::Transform> X_C2C1{X_C2W * first.view.X_WC};
  for (std::size_t i = 0; i < first.X_WM.size(); ++i) {
    X_C2C1.push_back(X_C2W * second.X_WM[i] * first.X_WM[i].Inverse() * first.view.X_WC);
  }
  return X_C2C1;
}

/// Whether a point at pixel `at` and `depth` m lies behind all four pixels about it, by more than their depth is known.
bool IsHidden(const DepthPicture& picture, const base::Vec2& at, double depth) {
  constexpr double kShare = 0.01;   // slope of surfaces between pixels
  constexpr double kMargin = 0.01;  // m
  const auto column = [&](double u) { return std::clamp(static_cast<int>(std::floor(u)), 0, picture.width - 1); };
  const auto row = [&](double v) { return std::clamp(static_cast<int>(std::floor(v)), 0, picture.height - 1); };
  for (const int y : {row(at.y()), row(at.y() + 1.0)}) {
    for (const int x : {column(at.x()), column(at.x() + 1.0)}) {
      const float there = picture.metres[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) +
                                         static_cast<std::size_t>(x)];
      if (there == 0.0F || depth <= static_cast<double>(there) * (1.0 + kShare) + kMargin) return false;
    }
  }
  return true;
}

FlowFate FateOf(const stack::CameraIntrinsics& k, const base::Vec2& at, double depth, const DepthPicture* second) {
  const bool inside = at.x() >= -0.5 && at.y() >= -0.5 && at.x() < k.width - 0.5 && at.y() < k.height - 0.5;
  if (!inside) return FlowFate::kOutside;
  return second != nullptr && IsHidden(*second, at, depth) ? FlowFate::kHidden : FlowFate::kSeen;
}

}  // namespace

void RangeFromDepth(const View& view, const DepthPicture& depth, RangePicture& out) {
  internal::CheckView(view);
  CheckSize(view, depth, depth.metres.size());
  out.width = depth.width;
  out.height = depth.height;
  out.metres.resize(depth.metres.size());
  const stack::CameraIntrinsics& k = view.intrinsics;
  std::size_t i = 0;
  for (int v = 0; v < out.height; ++v) {
    const double y = (v - k.cy) / k.fy;
    for (int u = 0; u < out.width; ++u, ++i) {
      const double x = (u - k.cx) / k.fx;
      out.metres[i] = static_cast<float>(static_cast<double>(depth.metres[i]) * std::sqrt(x * x + y * y + 1.0));
    }
  }
}

void OpticalFlow(const Moment& first, const DepthPicture& depth, const SurfacePicture& surface, const Moment& second,
                 const DepthPicture* second_depth, FlowPicture& out) {
  internal::CheckView(first.view);
  internal::CheckView(second.view);
  CheckSize(first.view, depth, depth.metres.size());
  CheckSize(first.view, surface, surface.instances.size());
  if (second_depth != nullptr) CheckSize(second.view, *second_depth, second_depth->metres.size());
  const std::vector<base::Transform> X_C2C1 = MotionsOf(first, second);
  out.width = depth.width;
  out.height = depth.height;
  out.motion.assign(depth.metres.size(), Eigen::Vector2f::Constant(std::numeric_limits<float>::quiet_NaN()));
  out.fates.assign(depth.metres.size(), FlowFate::kNothing);
  const stack::CameraIntrinsics& k1 = first.view.intrinsics;
  const stack::CameraIntrinsics& k2 = second.view.intrinsics;
  for (std::size_t i = 0; i < depth.metres.size(); ++i) {
    const double d = static_cast<double>(depth.metres[i]);
    const std::uint32_t instance = surface.instances[i];
    if (d == 0.0 || instance == 0) continue;
    const std::size_t motion = instance < surface.first_mover ? 0 : instance - surface.first_mover + 1;
    if (motion >= X_C2C1.size()) throw base::FaultError("render", "a mover is seen whose pose is not given");
    const base::Vec2 from(static_cast<double>(i % static_cast<std::size_t>(out.width)),
                          static_cast<double>(i / static_cast<std::size_t>(out.width)));
    const base::Vec3 p = X_C2C1[motion] * base::Vec3(d * (from.x() - k1.cx) / k1.fx, d * (from.y() - k1.cy) / k1.fy, d);
    out.fates[i] = FlowFate::kBehind;
    if (p.z() < internal::kNear) continue;
    const base::Vec2 to(k2.fx * p.x() / p.z() + k2.cx, k2.fy * p.y() / p.z() + k2.cy);
    out.motion[i] = (to - from).cast<float>();
    out.fates[i] = FateOf(k2, to, p.z(), second_depth);
  }
}

}  // namespace alula::render
