#include "sim/finite.h"

#include <cmath>
#include <variant>

namespace alula::sim {
namespace {

template <typename Derived>
bool Finite(const Eigen::DenseBase<Derived>& m) {
  return m.derived().array().isFinite().all();
}
bool Finite(const base::Transform& X) { return Finite(X.p) && Finite(X.q.coeffs()); }

std::string FirstIn(const stack::Estimate& e) {
  if (!Finite(e.X_OB)) return "estimate.X_OB";
  if (!Finite(e.v_OB)) return "estimate.v_OB";
  if (!Finite(e.w_B)) return "estimate.w_B";
  if (!Finite(e.X_MO)) return "estimate.X_MO";
  if (!Finite(e.pose_covariance)) return "estimate.pose_covariance";
  if (!Finite(e.velocity_covariance)) return "estimate.velocity_covariance";
  return {};
}

std::string FirstIn(const stack::Command& c) {
  if (const auto* p = std::get_if<stack::PositionSetpoint>(&c.what)) {
    if (!Finite(p->p_OB) || !Finite(p->v_OB) || !Finite(p->a_OB)) return "position set-point";
    if (!std::isfinite(p->yaw) || !std::isfinite(p->yaw_rate)) return "position set-point's yaw";
  }
  if (const auto* g = std::get_if<stack::GimbalSetpoint>(&c.what)) {
    if (!Finite(base::Vec3(g->roll, g->pitch, g->yaw))) return "gimbal set-point";
  }
  if (const auto* v = std::get_if<stack::VelocitySetpoint>(&c.what)) {
    if (!Finite(v->v_OB)) return "velocity set-point";
    if (!std::isfinite(v->yaw) || !std::isfinite(v->yaw_rate)) return "velocity set-point's yaw";
  }
  return {};
}

}  // namespace

bool IsFinite(const vehicles::BodyState& state) {
  return Finite(state.X_WB) && Finite(state.v_WB) && Finite(state.w_B);
}

std::string FirstNonFinite(const stack::StackOutput& output) {
  if (output.estimate) {
    if (std::string wrong = FirstIn(*output.estimate); !wrong.empty()) return wrong;
  }
  for (const stack::Command& command : output.commands) {
    if (std::string wrong = FirstIn(command); !wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace alula::sim
