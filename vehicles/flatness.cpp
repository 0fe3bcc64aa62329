#include "vehicles/flatness.h"

#include <cmath>

namespace alula::vehicles {

using base::Vec3;

FlatAttitude AttitudeFromThrust(const Vec3& a_W, const Vec3& jerk_W, double yaw, double yaw_rate) {
  const Vec3 specific = a_W + Vec3(0, 0, base::kGravity);
  const double thrust = specific.norm();
  const Vec3 z = specific / thrust;
  const Vec3 heading(std::cos(yaw), std::sin(yaw), 0), left(-std::sin(yaw), std::cos(yaw), 0);
  const Vec3 x = left.cross(z).normalized();
  const Vec3 y = z.cross(x);
  base::Mat3 R;
  R << x, y, z;

  // z' = w × z = −w_x y + w_y x; and x stays normal to l, the left of the heading h: w_z y·l − w_y z·l − yaw_rate x·h =
  // 0.
  const Vec3 z_rate = (jerk_W - z.dot(jerk_W) * z) / thrust;
  const double w_x = -z_rate.dot(y), w_y = z_rate.dot(x);
  const double w_z = (w_y * z.dot(left) + yaw_rate * x.dot(heading)) / y.dot(left);
  return {base::Quat(R).normalized(), {w_x, w_y, w_z}};
}

}  // namespace alula::vehicles
