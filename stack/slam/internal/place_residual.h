#pragma once

#include <optional>

#include "base/frames.h"
#include "stack/slam/place_view.h"
#include "stack/slam/relative_pose.h"

namespace alula::stack::slam::internal {

/// One match under a pose: residual, its Jacobian by (δt_BA, δθ: R_BA Exp(δθ)) and its information; the third row is
/// that of the disparity and 0 where there is none.
struct PlaceResidual {
  base::Vec3 r = base::Vec3::Zero();  // px
  Eigen::Matrix<double, 3, 6> jacobian = Eigen::Matrix<double, 3, 6>::Zero();
  base::Mat3 information = base::Mat3::Zero();  // S⁻¹
  int rows = 0;
  double squared = 0.0;  // rᵀ S⁻¹ r
};

/// Of point `a` of view A and point `b` of B under X_BA: a's place seen from B where a has a depth, else b's seen from
/// A; none where neither has or it would lie behind the camera.
std::optional<PlaceResidual> ResidualOf(const PlaceView& view_a, const PlacePoint& a, const PlaceView& view_b,
                                        const PlacePoint& b, const base::Transform& X_BA,
                                        const RelativePoseConfig& config);

/// Whether a residual is within the gate: χ of its rows against that of two.
bool Fits(const PlaceResidual& residual, const RelativePoseConfig& config);

}  // namespace alula::stack::slam::internal
