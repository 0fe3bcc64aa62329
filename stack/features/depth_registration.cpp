#include "stack/features/depth_registration.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "stack/interface/camera_model.h"

namespace alula::stack::features {

bool Registered(const CameraCalibration& a, const CameraCalibration& b) {
  const CameraIntrinsics &x = a.intrinsics, &y = b.intrinsics;
  constexpr double kSame = 1e-9;  // m and rad: what turning the frames about leaves of the identity
  return x.width == y.width && x.height == y.height && x.fx == y.fx && x.fy == y.fy && x.cx == y.cx && x.cy == y.cy &&
         x.distortion == y.distortion && x.model == y.model && (a.X_BC.p - b.X_BC.p).norm() < kSame &&
         base::Log(a.X_BC.q.conjugate() * b.X_BC.q).norm() < kSame;
}

DepthRegistration::DepthRegistration(const CameraCalibration& depth, const CameraCalibration& into)
    : into_(into.intrinsics),
      X_CD_(into.X_BC.Inverse() * depth.X_BC),
      width_(depth.intrinsics.width),
      height_(depth.intrinsics.height),
      magnification_{into.intrinsics.fx / depth.intrinsics.fx, into.intrinsics.fy / depth.intrinsics.fy} {
  turned_rays_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
  for (int v = 0; v < height_; ++v) {
    for (int u = 0; u < width_; ++u) {
      const base::Vec2 xy = Normalise(depth.intrinsics, base::Vec2(u, v));
      turned_rays_.push_back((X_CD_.q * base::Vec3(xy.x(), xy.y(), 1.0)).cast<float>());
    }
  }
}

DepthImage DepthRegistration::operator()(const DepthImage& image) const {
  if (image.width != width_ || image.height != height_) {
    throw base::FaultError("registration", "a depth image is not of its camera's size");
  }
  constexpr double kHalf = 0.55;  // of a pixel: a tenth of overlap closes what rounding and a small turn leave open
  std::vector<std::uint16_t> seen(static_cast<std::size_t>(into_.width) * static_cast<std::size_t>(into_.height));
  // The first pixel whose centre lies at or beyond a border.
  const auto from = [](double border, int size) {
    return static_cast<int>(std::ceil(std::clamp<double>(border, 0, size)));
  };
  for (std::size_t i = 0; i < turned_rays_.size(); ++i) {
    const double z_D = 1e-3 * (*image.millimetres)[i];
    if (z_D == 0) continue;
    const base::Vec3 p_C = z_D * turned_rays_[i].cast<double>() + X_CD_.p;
    const double millimetres = std::round(1e3 * p_C.z());
    if (!(millimetres >= 1 && millimetres <= UINT16_MAX)) continue;
    const base::Vec2 pixel = Project(into_, p_C);
    const double half_u = kHalf * magnification_[0] * z_D / p_C.z(), half_v = kHalf * magnification_[1] * z_D / p_C.z();
    const int last_u = from(pixel.x() + half_u, into_.width), last_v = from(pixel.y() + half_v, into_.height);
    for (int v = from(pixel.y() - half_v, into_.height); v < last_v; ++v) {
      for (int u = from(pixel.x() - half_u, into_.width); u < last_u; ++u) {
        std::uint16_t& depth =
            seen[static_cast<std::size_t>(v) * static_cast<std::size_t>(into_.width) + static_cast<std::size_t>(u)];
        if (depth == 0 || millimetres < depth) depth = static_cast<std::uint16_t>(millimetres);
      }
    }
  }
  return {.width = into_.width,
          .height = into_.height,
          .exposure_start = image.exposure_start,
          .exposure = image.exposure,
          .millimetres = std::make_shared<const std::vector<std::uint16_t>>(std::move(seen))};
}

}  // namespace alula::stack::features
