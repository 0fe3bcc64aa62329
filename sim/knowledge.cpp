#include "sim/knowledge.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/random.h"

namespace alula::sim {

void Describe(base::Description& d, KnowledgeErrors& c) {
  d.Field("extrinsics_angle", c.extrinsics_angle,
          {.unit = "rad", .meaning = "camera against IMU, standard deviation per axis", .min = 0});
  d.Field("extrinsics_position", c.extrinsics_position,
          {.unit = "m", .meaning = "camera against IMU, standard deviation per axis", .min = 0});
  d.Field("eye_angle", c.eye_angle,
          {.unit = "rad", .meaning = "one eye against the other, standard deviation per axis", .min = 0});
  d.Field("baseline", c.baseline, {.unit = "1", .meaning = "standard deviation as a share of the baseline", .min = 0});
  d.Field("focal", c.focal,
          {.unit = "1", .meaning = "standard deviation as a share of the focal length, both eyes alike", .min = 0});
  d.Field("time_offset", c.time_offset, {.unit = "s", .meaning = "camera against IMU, standard deviation"});
  d.Field("start_position", c.start_position, {.unit = "m", .meaning = "standard deviation per axis", .min = 0});
  d.Field("start_yaw", c.start_yaw, {.unit = "rad", .meaning = "standard deviation", .min = 0});
  d.Field("gate_offset_min", c.gate_offset_min,
          {.unit = "m", .meaning = "least error of a gate's place in its plane", .min = 0});
  d.Field("gate_offset_max", c.gate_offset_max,
          {.unit = "m", .meaning = "largest error of a gate's place in its plane", .min = 0});
  d.Field("gate_yaw", c.gate_yaw, {.unit = "rad", .meaning = "bound of the error of a gate's heading", .min = 0});
  d.Field("declination", c.declination,
          {.unit = "rad", .meaning = "of Earth's magnetic field, standard deviation", .min = 0});
  d.Check("gate_offset_max", [&c] {
    return c.gate_offset_max < c.gate_offset_min ? "is below gate_offset_min; must be at least that" : std::string();
  });
}

stack::Calibration Misjudge(const stack::Calibration& truth, const KnowledgeErrors& errors, std::uint64_t seed) {
  stack::Calibration judged = truth;
  if (judged.magnetometer) {
    base::RandomStream declination(seed, "knowledge/calibration/declination");
    base::Vec3& B_W = judged.magnetometer->B_W;
    B_W = base::FromYaw(errors.declination * declination.Gaussian()) * B_W;
  }
  if (truth.cameras.empty()) return judged;
  base::RandomStream extrinsics(seed, "knowledge/calibration/extrinsics");
  base::RandomStream eyes(seed, "knowledge/calibration/eyes");
  base::RandomStream focal(seed, "knowledge/calibration/focal");
  base::RandomStream offset(seed, "knowledge/calibration/time_offset");

  // One rig moves as a whole against the IMU; then the other eyes move against the first.
  const base::Transform X_BC = truth.cameras[0].X_BC;
  const base::Vec3 dp = errors.extrinsics_position * extrinsics.GaussianVec3();
  const base::Vec3 dtheta = errors.extrinsics_angle * extrinsics.GaussianVec3();
  const base::Transform X_BC_judged{(X_BC.q * base::Exp(dtheta)).normalized(), X_BC.p + dp};
  const double scale = 1.0 + errors.focal * focal.Gaussian();
  const base::Duration shift = base::Seconds(errors.time_offset.Seconds() * offset.Gaussian());
  for (std::size_t i = 0; i < judged.cameras.size(); ++i) {
    stack::CameraCalibration& camera = judged.cameras[i];
    base::Transform X_C0C = X_BC.Inverse() * truth.cameras[i].X_BC;
    if (i > 0) {
      X_C0C.q = (X_C0C.q * base::Exp(errors.eye_angle * eyes.GaussianVec3())).normalized();
      X_C0C.p *= 1.0 + errors.baseline * eyes.Gaussian();
    }
    camera.X_BC = X_BC_judged * X_C0C;
    camera.intrinsics.fx *= scale;
    camera.intrinsics.fy *= scale;
    camera.time_offset = camera.time_offset + shift;
  }
  return judged;
}

base::Transform StartPose(const worlds::World& world, double standing_height) {
  return {world.X_WB_start.q, world.X_WB_start.p + base::Vec3(0.0, 0.0, standing_height)};
}

stack::Mission SurveyMission(const worlds::World& world, const base::Transform& X_WB,
                             const std::vector<base::Vec3>& waypoints_W, const KnowledgeErrors& errors,
                             std::uint64_t seed) {
  base::RandomStream start(seed, "knowledge/mission/start");
  base::RandomStream gates(seed, "knowledge/mission/gates");
  stack::Mission mission;
  mission.X_WB_start.p = X_WB.p + errors.start_position * start.GaussianVec3();
  mission.X_WB_start.q = (base::FromYaw(errors.start_yaw * start.Gaussian()) * X_WB.q).normalized();
  mission.start_position_sigma = errors.start_position;
  mission.start_yaw_sigma = errors.start_yaw;
  mission.takeoff_column_radius = world.pad_radius;
  for (const worlds::Gate& gate : world.gates) {
    const double magnitude = gates.Uniform(errors.gate_offset_min, errors.gate_offset_max);
    const double direction = gates.Uniform(0.0, 2.0 * std::numbers::pi);
    const double yaw = gates.Uniform(-errors.gate_yaw, errors.gate_yaw);
    const base::Vec3 shift_G(0.0, magnitude * std::cos(direction), magnitude * std::sin(direction));
    mission.gates.push_back(
        {gate.name, {(base::FromYaw(yaw) * gate.X_WG.q).normalized(), gate.X_WG * shift_G}, gate.opening});
  }
  mission.gate_position_error = errors.gate_offset_max;
  mission.gate_angle_error = errors.gate_yaw;
  mission.waypoints = waypoints_W;
  mission.target = world.target;
  mission.bounds_low = world.bounds_low;
  mission.bounds_high = world.bounds_high;
  return mission;
}

}  // namespace alula::sim
