#pragma once

#include <ceres/sized_cost_function.h>

#include <array>

#include "stack/estimation/internal/parameters.h"

namespace alula::stack::estimation {

/// What the reprojections of one stereo pair share: the nominal rig, and the motion during the time offset.
struct PairModel {
  base::Transform X_IC;                  // nominal pose of the left camera in the IMU frame
  base::Transform X_RL;                  // nominal pose of the left camera in the right one's frame
  base::Vec3 v_OI = base::Vec3::Zero();  // m/s, at the stamp (held during a solve)
  base::Vec3 w_I = base::Vec3::Zero();   // rad/s, at the stamp
  double weight = 1.0;                   // focal length over the pixel's sigma

  /// All that depends on the pose and the rig's refinement alone, and not on the landmark.
  struct Geometry {
    std::array<double, kPoseSize + kRigSize> parameters{};
    bool valid = false;
    base::Mat3 turn_T;          // transpose of the IMU's turn during the time offset
    base::Mat3 R_IO;            // O → I at the exposure
    base::Vec3 p_OI;            // of the IMU at the exposure
    base::Mat3 R_LI, R_RL;      // I → left camera → right camera, refined
    base::Vec3 p_IL, p_RL;      // left camera in I; left camera in the right one
    base::Mat3 J_theta, J_psi;  // right Jacobians of the refinements
  };
  /// Computed anew only when a parameter has changed: hundreds of landmarks ask for the same. One thread.
  const Geometry& At(const double* pose, const double* rig) const;
  /// To be called after v_OI, w_I or the nominal rig were changed.
  void Invalidate() { geometry_.valid = false; }

 private:
  mutable Geometry geometry_;
};

/// Reprojection of a landmark into one eye, in sigmas; blocks: pose, landmark, rig.
///
///   p_I = Exp(w t)ᵀ R_OIᵀ (p_O − p_OI − v t),   p_L = Exp(θ)ᵀ X_IC⁻¹ p_I,   p_R = Exp(ψ)ᵀ X_RL p_L,
///   r = weight · (p_xy / p_z − z)
///
/// with the rig's refinements θ (3), ψ (2, about x and y) and t. Behind the camera the factor fails: the step that
/// brings a landmark there is refused.
class ReprojectionFactor final : public ceres::SizedCostFunction<2, kPoseSize, kLandmarkSize, kRigSize> {
 public:
  ReprojectionFactor(const PairModel& pair, bool right, const base::Vec2& seen)
      : pair_(&pair), right_(right), seen_(seen) {}
  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

  const base::Vec2& seen() const { return seen_; }

 private:
  const PairModel* pair_;
  bool right_;
  base::Vec2 seen_;  // normalised
};

}  // namespace alula::stack::estimation
