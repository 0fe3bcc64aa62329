#include "stack/pilot/map_alignment.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace alula::stack::pilot {

using base::Vec3;

void Describe(base::Description& d, MapAlignmentConfig& c) {
  d.Field("hint_sigma", c.hint_sigma,
          {.unit = "m", .meaning = "1 sigma of a gate's listed place, per axis", .min = 0.001, .max = 10});
  d.Field("start_position_sigma", c.start_position_sigma,
          {.unit = "m", .meaning = "of the start, where the mission states none", .min = 0.001, .max = 10});
  d.Field("start_yaw_sigma", c.start_yaw_sigma,
          {.unit = "rad", .meaning = "of the start heading, where the mission states none", .min = 1e-4, .max = 3});
  d.Field("huber", c.huber, {.meaning = "sigmas beyond which a gate's pull grows no more", .min = 0.1, .max = 100});
}

base::Transform AlignMap(const std::vector<AlignmentPair>& pairs, const Vec3& start_O, double position_sigma,
                         double yaw_sigma, const MapAlignmentConfig& config) {
  if (pairs.empty()) return {};
  Vec3 t = Vec3::Zero();
  double yaw = 0.0;
  for (int iteration = 0; iteration < 8; ++iteration) {
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();  // of (t, yaw)
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    H.diagonal() << Vec3::Constant(1.0 / (position_sigma * position_sigma)), 1.0 / (yaw_sigma * yaw_sigma);
    g.head<3>() = t / (position_sigma * position_sigma);
    g[3] = yaw / (yaw_sigma * yaw_sigma);
    const base::Quat rotation = base::FromYaw(yaw);
    for (const AlignmentPair& pair : pairs) {
      const Vec3 arm = rotation * (pair.p_O - start_O);
      const Vec3 residual = arm + start_O + t - pair.p_M;
      const double sigma = std::hypot(config.hint_sigma, pair.sigma);
      const double size = residual.norm() / sigma;
      const double weight = (size > config.huber ? config.huber / size : 1.0) / (sigma * sigma);
      Eigen::Matrix<double, 3, 4> J;
      J.leftCols<3>().setIdentity();
      J.col(3) = Vec3::UnitZ().cross(arm);
      H += weight * J.transpose() * J;
      g += weight * J.transpose() * residual;
    }
    const Eigen::Vector4d step = H.ldlt().solve(-g);
    t += step.head<3>();
    yaw += step[3];
    if (step.norm() < 1e-9) break;
  }
  const base::Quat rotation = base::FromYaw(yaw);
  return {rotation, start_O + t - rotation * start_O};
}

}  // namespace alula::stack::pilot
