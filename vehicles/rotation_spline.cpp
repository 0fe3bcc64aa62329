#include "vehicles/rotation_spline.h"

#include <algorithm>
#include <utility>

#include "vehicles/spline_fit.h"

namespace alula::vehicles {

using base::Quat;
using base::Vec3;

RotationSpline::RotationSpline(std::vector<Quat> control) : control_(std::move(control)) {
  for (std::size_t i = 1; i < control_.size(); ++i) {
    step_.push_back(base::Log(control_[i - 1].conjugate() * control_[i]));
  }
}

RotationSpline::Sample RotationSpline::At(double u) const {
  const int last = static_cast<int>(control_.size()) - 6;
  const int segment = std::clamp(static_cast<int>(u), 0, last);
  const QuinticBasis basis = QuinticBasisAt(std::clamp(u - segment, 0.0, 1.0));
  Sample sample;
  sample.q = control_[static_cast<std::size_t>(segment)];
  double lambda = 1.0 - basis.value[0], slope = -basis.slope[0];
  for (std::size_t j = 1; j <= 5; ++j) {
    const Vec3& d = step_[static_cast<std::size_t>(segment) + j - 1];
    const Quat turn = base::Exp(lambda * d);
    sample.w = turn.conjugate() * sample.w + slope * d;
    sample.q = sample.q * turn;
    lambda -= basis.value[j];
    slope -= basis.slope[j];
  }
  sample.q.normalize();
  return sample;
}

RotationSpline FitRotations(const std::vector<double>& u, const std::vector<Quat>& q, int segments) {
  constexpr int kRounds = 30;
  constexpr double kStill = 1e-10;  // rad
  const SplineFit fit(u, segments);
  std::vector<Quat> control;
  for (int j = 0; j < fit.controls(); ++j) {
    const auto next = std::lower_bound(u.begin(), u.end(), static_cast<double>(j - 2));
    const auto i = static_cast<std::size_t>(std::min(next - u.begin(), static_cast<std::ptrdiff_t>(u.size()) - 1));
    control.push_back(q[i]);
  }
  std::vector<Vec3> residuals(u.size());
  for (int round = 0; round < kRounds; ++round) {
    const RotationSpline spline(control);
    for (std::size_t i = 0; i < u.size(); ++i) residuals[i] = base::Log(q[i] * spline.At(u[i]).q.conjugate());
    const std::vector<Vec3> turns = fit.Solve(residuals);
    double largest = 0;
    for (std::size_t j = 0; j < control.size(); ++j) {
      control[j] = (base::Exp(turns[j]) * control[j]).normalized();
      largest = std::max(largest, turns[j].norm());
    }
    if (largest < kStill) break;
  }
  return RotationSpline(std::move(control));
}

}  // namespace alula::vehicles
