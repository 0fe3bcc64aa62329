#pragma once

#include <optional>

#include "stack/slam/bundle_adjustment.h"

namespace alula::stack::slam {

using Mat36 = Eigen::Matrix<double, 3, 6>;

/// A pose with what its sights need.
struct View {
  base::Mat3 R_LM;  // left camera
  base::Vec3 p_LM;
  base::Mat3 R_LB;
  base::Mat3 R_RL = base::Mat3::Identity();
  base::Vec3 p_RL = base::Vec3::Zero();
};
View ViewFrom(const base::Transform& X_MB, const Eyes& eyes);

/// A sight's residual in σ: left x, left y, and along the epipolar line of the right eye (0 without one); with `by_L`
/// its derivative by the point in the left camera's frame, the direction of the epipolar line held. False behind an
/// eye.
bool SightResidual(const View& view, const Sight& sight, const base::Vec3& p_M, base::Vec3& r, base::Mat3* by_L);

/// Derivative by the pose's tangent (δp in M, δθ in B) of what has the derivative `by_L`: p_M stands still, so p_B
/// moves by −R_BM δp + [p_B]× δθ.
Mat36 ByPose(const base::Mat3& by_L, const View& view, const base::Transform& X_MB, const base::Vec3& p_M);

/// r = (R_FM (p_T − p_F) − z, Log(Z⁻¹ R_FT)) / σ, and its derivatives by both tangents.
base::Vec6 MotionResidual(const base::Transform& X_MF, const base::Transform& X_MT, const RelativeMotion& motion);
void MotionJacobians(const base::Transform& X_MF, const base::Transform& X_MT, const RelativeMotion& motion,
                     base::Mat6& by_F, base::Mat6& by_T);

/// r = (R_BM e_z − up_B) / σ, and its derivative by δθ.
base::Vec3 VerticalResidual(const base::Transform& X_MB, const Vertical& vertical);
base::Mat3 VerticalJacobian(const base::Transform& X_MB, const Vertical& vertical);

}  // namespace alula::stack::slam
