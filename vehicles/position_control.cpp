#include "vehicles/position_control.h"

#include <algorithm>
#include <cmath>

namespace alula::vehicles {

using base::Vec3;

void Describe(base::Description& d, PositionControlConfig& c) {
  const auto gain = [&d](std::string_view name, double& value, std::string_view unit, std::string_view meaning) {
    d.Field(name, value, {.unit = unit, .meaning = meaning, .min = 0, .max = 100});
  };
  gain("position_gain", c.position_gain, "1/s", "horizontal velocity per position error");
  gain("velocity_gain", c.velocity_gain, "1/s", "horizontal acceleration per velocity error");
  gain("velocity_integral", c.velocity_integral, "1/s^2", "growth of acceleration per velocity error");
  gain("vertical_position_gain", c.vertical_position_gain, "1/s", "vertical velocity per height error");
  gain("vertical_velocity_gain", c.vertical_velocity_gain, "1/s", "vertical acceleration per velocity error");
  gain("vertical_integral", c.vertical_integral, "1/s^2", "growth of vertical acceleration per velocity error");
  gain("maximum_speed", c.maximum_speed, "m/s", "horizontal speed limit");
  gain("maximum_climb", c.maximum_climb, "m/s", "climb rate limit");
  gain("maximum_descent", c.maximum_descent, "m/s", "descent rate limit");
  gain("maximum_correction", c.maximum_correction, "m/s", "velocity that the position loop may add");
  d.Field("maximum_tilt", c.maximum_tilt,
          {.unit = "rad", .meaning = "largest tilt of the thrust", .min = 0.05, .max = 1.4});
  d.Field("minimum_thrust", c.minimum_thrust,
          {.meaning = "least collective thrust in flight over weight", .min = 0.01, .max = 0.9});
  gain("maximum_integral", c.maximum_integral, "m/s^2", "limit of each integral");
  gain("drag_compensation", c.drag_compensation, "1/s", "acceleration per horizontal velocity, fed forward");
  gain("acceleration_lead", c.acceleration_lead, "s", "how far ahead the set-point's acceleration is taken");
}

Vec3 LimitThrust(const Vec3& f, double maximum_tilt, double minimum, double maximum) {
  Vec3 limited(f.x(), f.y(), std::clamp(f.z(), minimum, maximum));
  const double widest = std::min(limited.z() * std::tan(maximum_tilt),
                                 std::sqrt(std::max(0.0, maximum * maximum - limited.z() * limited.z())));
  const double wide = limited.head<2>().norm();
  if (wide > widest) limited.head<2>() *= widest / wide;
  return limited;
}

Vec3 PositionControl::VelocitySetpoint(const MotionSetpoint& setpoint, const Vec3& p_OB, double climb_limit) const {
  const PositionControlConfig& c = config_;
  const Vec3 gain(c.position_gain, c.position_gain, c.vertical_position_gain);
  Vec3 correction = gain.cwiseProduct(setpoint.position_weight).cwiseProduct(setpoint.p_OB - p_OB);
  const double wide = correction.head<2>().norm();
  if (wide > c.maximum_correction) correction.head<2>() *= c.maximum_correction / wide;

  Vec3 v = setpoint.v_OB + correction;
  const double speed = v.head<2>().norm();
  if (speed > c.maximum_speed) v.head<2>() *= c.maximum_speed / speed;
  v.z() = std::clamp(v.z(), -c.maximum_descent, std::min(climb_limit, c.maximum_climb));
  return v;
}

Vec3 PositionControl::Step(const MotionSetpoint& setpoint, const Vec3& p_OB, const Vec3& v_OB, double maximum_thrust,
                           double climb_limit, bool integrate, double dt) {
  const PositionControlConfig& c = config_;
  const Vec3 v_sp = VelocitySetpoint(setpoint, p_OB, climb_limit);
  const Vec3 error = v_sp - v_OB;
  const Vec3 gain(c.velocity_gain, c.velocity_gain, c.vertical_velocity_gain);
  const Vec3 drag = c.drag_compensation * Vec3(v_sp.x(), v_sp.y(), 0);
  const Vec3 wanted = setpoint.a_OB + c.acceleration_lead * setpoint.jerk_OB + gain.cwiseProduct(error) + integral_ +
                      drag + Vec3(0, 0, base::kGravity);
  const Vec3 f = LimitThrust(wanted, c.maximum_tilt, c.minimum_thrust * base::kGravity, maximum_thrust);

  if (integrate) {
    const Vec3 cut = wanted - f;  // what saturation took: the integral must not push further into it
    Vec3 growth = Vec3(c.velocity_integral, c.velocity_integral, c.vertical_integral).cwiseProduct(error) * dt;
    if (cut.head<2>().dot(growth.head<2>()) > 0) growth.head<2>().setZero();
    if (cut.z() * growth.z() > 0) growth.z() = 0;
    integral_ = (integral_ + growth).cwiseMax(-c.maximum_integral).cwiseMin(c.maximum_integral);
  }
  return f;
}

}  // namespace alula::vehicles
