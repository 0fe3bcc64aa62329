#include "stack/slam/internal/place_residual.h"

namespace alula::stack::slam::internal {
namespace {

using base::Mat3;
using base::Transform;
using base::Vec2;
using base::Vec3;

constexpr double kNearest = 0.05;  // m in front of the camera

/// Covariance of a point's place (m²) from that of its (u, v, disparity): p = z (x, y, 1) with z = f b / d.
Mat3 PlaceCovariance(const PlaceView& view, const PlacePoint& point, const RelativePoseConfig& config) {
  const Vec3& p = *point.p_C;
  const double pixel = config.pixel_sigma * point.scale * p.z() / view.focal;
  const double depth = p.z() * p.z() / view.focal_baseline * config.disparity_sigma * point.scale;
  const Vec3 ray = p / p.z();
  Mat3 covariance = depth * depth * ray * ray.transpose();
  covariance(0, 0) += pixel * pixel;
  covariance(1, 1) += pixel * pixel;
  return covariance;
}

/// (f x/z, f y/z, f b/z) by (x, y, z); the last row 0 where the disparity is not observed.
Mat3 ProjectionJacobian(const PlaceView& view, const Vec3& p, bool disparity) {
  const double f = view.focal / p.z();
  Mat3 h;
  h << f, 0, -f * p.x() / p.z(), 0, f, -f * p.y() / p.z(), 0, 0,
      disparity ? -view.focal_baseline / (p.z() * p.z()) : 0.0;
  return h;
}

/// A point of the `from` view, known there, as the `to` view should see it.
struct Transfer {
  const PlaceView& from;
  const PlacePoint& source;
  const PlaceView& to;
  const PlacePoint& target;
};

/// Fills all but the Jacobian by the pose; `h` is that by the place in the `to` frame.
std::optional<PlaceResidual> Compare(const Transfer& t, const Transform& X, const RelativePoseConfig& config, Mat3& h) {
  const Vec3 p = X * *t.source.p_C;
  if (p.z() < kNearest) return std::nullopt;
  const bool disparity = t.target.p_C.has_value();
  h = ProjectionJacobian(t.to, p, disparity);
  PlaceResidual residual;
  residual.rows = disparity ? 3 : 2;
  residual.r.head<2>() = t.to.focal * (Vec2(p.head<2>() / p.z()) - t.target.normalised);
  if (disparity) residual.r.z() = t.to.focal_baseline * (1.0 / p.z() - 1.0 / t.target.p_C->z());
  const Mat3 turn = h * X.R();
  Mat3 covariance = turn * PlaceCovariance(t.from, t.source, config) * turn.transpose();
  const double pixel = config.pixel_sigma * t.target.scale, disparity_sigma = config.disparity_sigma * t.target.scale;
  covariance(0, 0) += pixel * pixel;
  covariance(1, 1) += pixel * pixel;
  covariance(2, 2) += disparity ? disparity_sigma * disparity_sigma : 1.0;
  residual.information = covariance.inverse();
  residual.squared = residual.r.dot(residual.information * residual.r);
  return residual;
}

}  // namespace

std::optional<PlaceResidual> ResidualOf(const PlaceView& view_a, const PlacePoint& a, const PlaceView& view_b,
                                        const PlacePoint& b, const Transform& X_BA, const RelativePoseConfig& config) {
  Mat3 h;
  if (a.p_C) {
    auto residual = Compare({view_a, a, view_b, b}, X_BA, config, h);
    if (!residual) return std::nullopt;
    // p_B = R Exp(δθ) p_A + t + δt.
    residual->jacobian.leftCols<3>() = h;
    residual->jacobian.rightCols<3>() = -h * X_BA.R() * base::Hat(*a.p_C);
    return residual;
  }
  if (!b.p_C) return std::nullopt;
  const Transform X_AB = X_BA.Inverse();
  auto residual = Compare({view_b, b, view_a, a}, X_AB, config, h);
  if (!residual) return std::nullopt;
  // p_A = Exp(−δθ) Rᵀ (p_B − t − δt).
  residual->jacobian.leftCols<3>() = -h * X_AB.R();
  residual->jacobian.rightCols<3>() = h * base::Hat(X_AB * *b.p_C);
  return residual;
}

bool Fits(const PlaceResidual& residual, const RelativePoseConfig& config) {
  const double factor = residual.rows == 3 ? 1.3 : 1.0;  // χ² at 98.9 %: 11.1 with three rows, 9 with two
  return residual.squared < factor * config.gate * config.gate;
}

}  // namespace alula::stack::slam::internal
