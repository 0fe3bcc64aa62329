#pragma once

#include <vector>

#include "base/frames.h"

namespace alula::vehicles {

/// A uniform quintic B-spline of rotations in cumulative form (Sommer et al. 2020, eq. 7 and 22):
///
///   q(u) = q_i Π_{j=1…5} Exp(λ_j(t) d_j),   d_j = Log(q_{i+j−1}⁻¹ q_{i+j}),   λ_j = Σ_{l≥j} B_l,   t = u − i.
///
/// Four times continuously differentiable: angular velocity and acceleration have no steps.
class RotationSpline {
 public:
  RotationSpline() = default;
  /// At least six control rotations; neighbours less than half a turn apart.
  explicit RotationSpline(std::vector<base::Quat> control);

  struct Sample {
    base::Quat q = base::Quat::Identity();
    base::Vec3 w = base::Vec3::Zero();  // dq/du = q · w/2: in the turned frame, rad per unit of u
  };
  /// At u clamped to [0, segments].
  Sample At(double u) const;

 private:
  std::vector<base::Quat> control_;
  std::vector<base::Vec3> step_;  // d: from each control rotation to the next
};

/// The spline whose rotations lie nearest to samples `q` at `u` (ascending, in [0, segments]). Starts from the samples
/// above the control points; then every residual Log(q_i q(u_i)⁻¹) is fitted by a spline of vectors (spline_fit.h),
/// whose control points turn the control rotations, until nothing moves. With knots so near that the rotation over one
/// is small, what is left out (how a sample turns with its control rotations) is of second order.
RotationSpline FitRotations(const std::vector<double>& u, const std::vector<base::Quat>& q, int segments);

}  // namespace alula::vehicles
